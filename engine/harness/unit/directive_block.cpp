#include "harness/unit/directive_block.hpp"

#include <algorithm>
#include <cctype>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::harness {
namespace {

/// What follows "///", or nothing.
std::string commentIn(const std::string& line) {
    const size_t at = line.find_first_not_of(" \t");
    return at != std::string::npos && line.compare(at, 3, "///") == 0 ? line.substr(at) : "";
}

/// Brackets opened and not closed, outside of quotes.
int openBrackets(const std::string& text) {
    int depth = 0;
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') quoted = !quoted;
        if (!quoted) depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    }
    return depth;
}

/// Where the next directive starts at or after `from`: an '@' before a letter, after a space, not in quotes.
size_t nextDirective(const std::string& text, size_t from) {
    bool quoted = false;
    for (size_t i = from; i + 1 < text.size(); ++i) {
        if (text[i] == '"') quoted = !quoted;
        const bool first = i == 0 || std::isspace(static_cast<unsigned char>(text[i - 1])) != 0;
        if (text[i] == '@' && !quoted && first && std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0)
            return i;
    }
    return text.size();
}

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> withAt(std::vector<std::string> names) {
    for (std::string& name : names)
        name.insert(0, "@");
    return names;
}

void readLine(const std::string& line, const SourcePlace& place, std::vector<Directive>& out) {
    for (size_t at = nextDirective(line, 0); at < line.size();) {
        const size_t end = nextDirective(line, at + 1);
        const std::string whole = line.substr(at + 1, end - at - 1);
        const size_t space = std::min(whole.find_first_of(" \t\r"), whole.size());
        out.push_back({whole.substr(0, space), trimmed(whole.substr(space)), place});
        at = end;
    }
}

}  // namespace

const std::vector<std::string>& directiveNames() {
    static const std::vector<std::string> names{"test", "tag",   "in",    "expect",   "inputs",
                                                "seed", "stage", "model", "must_fail"};
    return names;
}

std::vector<DirectiveBlock> directiveBlocks(const std::vector<std::string>& lines, const std::string& file) {
    const auto isOurs = [](const Directive& directive) {
        const auto& names = directiveNames();
        return std::find(names.begin(), names.end(), directive.name) != names.end();
    };
    std::vector<DirectiveBlock> blocks;
    for (size_t i = 0; i < lines.size(); ++i) {
        if (commentIn(lines[i]).empty()) continue;
        DirectiveBlock block;
        for (; i < lines.size() && !commentIn(lines[i]).empty(); ++i) {
            std::string text = commentIn(lines[i]).substr(3);
            const SourcePlace place{file, static_cast<int>(i) + 1};
            while (nextDirective(text, 0) < text.size() && openBrackets(text) > 0 && i + 1 < lines.size() &&
                   !commentIn(lines[i + 1]).empty())
                text += " " + commentIn(lines[++i]).substr(3);
            readLine(text, place, block.directives);
        }
        block.end = i;
        if (std::none_of(block.directives.begin(), block.directives.end(), isOurs)) continue;
        for (const Directive& directive : block.directives)
            if (!isOurs(directive))
                throw InputError(directive.place.text() + ": unknown directive @" + directive.name +
                                 didYouMean("@" + directive.name, withAt(directiveNames())));
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace lobe::harness
