#include <iostream>

#include "arguments.hpp"
#include "commands.hpp"
#include "settings.hpp"

namespace lobe::app {

int helpCommand(const std::vector<std::string>& list) {
    Arguments arguments("help", "List every setting.");
    bool markdown = false;
    arguments.app().add_flag("--markdown", markdown, "as a table");
    if (!arguments.parse(list)) return 0;
    if (markdown)
        std::cout << "| key | flag | value | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const Setting& setting : settingTable()) {
        const std::string shown = setting.defaultText();
        std::string value = setting.allowed();
        if (markdown) {
            for (size_t at = 0; (at = value.find('|', at)) != std::string::npos; at += 2)
                value.insert(at, "\\");
            std::cout << "| `" << setting.key << "` | `" << setting.flag() << "` | " << value << " | "
                      << shown << " | " << setting.help << " |\n";
        } else {
            std::cout << setting.key << " (" << value << ")" << (shown.empty() ? "" : " [" + shown + "]")
                      << ": " << setting.help << '\n';
        }
    }
    return 0;
}

}  // namespace lobe::app
