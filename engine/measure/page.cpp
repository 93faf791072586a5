#include "measure/page.hpp"

#include <cereal/external/base64.hpp>
#include <fstream>
#include <iterator>
#include <string_view>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string readFile(const fs::path& path) {
    std::error_code failed;
    std::ifstream file(path, std::ios::binary);
    if (!fs::is_regular_file(path, failed) || !file) throw InputError(path.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string dataUri(const std::string& name, const std::string& bytes) {
    const std::string_view view = bytes;
    const char* type = view.starts_with("\x89PNG\r\n\x1a\n")                              ? "image/png"
                       : view.starts_with("\xff\xd8\xff")                                 ? "image/jpeg"
                       : view.starts_with("RIFF") && view.substr(0, 12).ends_with("WEBP") ? "image/webp"
                                                                                          : nullptr;
    if (type == nullptr)
        throw InputError("report: pictures: " + name + ": unknown format; expected PNG, JPEG or WebP");
    return "data:" + std::string(type) + ";base64," +
           cereal::base64::encode(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

/// JSON that can stand inside <script>: there only '<' can end or change the element, and in JSON it only
/// occurs in strings. Text that is not UTF-8 is replaced.
std::string scriptJson(const json& value) {
    const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    }
    return safe;
}

json pictureUris(const json& report, const PictureLoader& load) {
    json uris = json::object();
    const auto pictures = report.find("pictures");
    if (pictures == report.end() || pictures->is_null()) return uris;
    if (!pictures->is_object()) throw InputError("report: pictures: expected an object of names and files");
    for (const auto& [name, file] : pictures->items()) {
        if (!file.is_string()) throw InputError("report: pictures: " + name + ": expected a file name");
        uris[name] = dataUri(name, load(file.get<std::string>()));
    }
    return uris;
}

}  // namespace

std::string reportPage(const json& report, const PictureLoader& load) {
    const auto schema = report.is_object() ? report.find("schema") : report.end();
    if (!report.is_object() || schema == report.end() || *schema != 1)
        throw InputError("report: schema: " +
                         (report.is_object() && schema != report.end() ? scriptJson(*schema) : "missing") +
                         "; expected 1");
    const fs::path folder = pageDirectory();
    const std::string frame = readFile(folder / "report.html");
    // What replaces a {{name}} is not searched again: nothing in a report can be taken for one.
    std::string page;
    std::size_t done = 0;
    for (std::size_t open; (open = frame.find("{{", done)) != std::string::npos;) {
        const std::size_t close = frame.find("}}", open);
        if (close == std::string::npos)
            throw InputError((folder / "report.html").string() + ": {{ without }}");
        page.append(frame, done, open - done);
        const std::string name = frame.substr(open + 2, close - open - 2);
        if (name == "report")
            page += scriptJson(report);
        else if (name == "pictures")
            page += scriptJson(pictureUris(report, load));
        else
            page += readFile(folder / name);
        done = close + 2;
    }
    return page.append(frame, done);
}

void writeReportPage(const json& report, const fs::path& folder) {
    const fs::path root = fs::weakly_canonical(folder);
    const PictureLoader load = [&](const std::string& file) {
        // A report may come from anyone: it must not carry other files of this machine into a page.
        const fs::path path = fs::weakly_canonical(root / file);
        const fs::path inside = path.lexically_relative(root);
        if (inside.empty() || *inside.begin() == "..")
            throw InputError("report: pictures: " + file + ": outside of " + folder.string());
        return readFile(path);
    };
    writeAtomically(folder / "report.html", reportPage(report, load));
}

}  // namespace lobe
