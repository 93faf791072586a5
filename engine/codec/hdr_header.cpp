#include "codec/hdr_header.hpp"

namespace lobe::codec::hdr {
namespace {

constexpr std::string_view kMark = "#lobe ";

/// Calls for every line of the header, which an empty one ends; returns where that is, or the end of the last
/// line.
template<class Visit>
size_t forEachLine(std::string_view text, const Visit& visit) {
    size_t at = 0;
    for (size_t end = text.find('\n'); end != std::string_view::npos && end > at; end = text.find('\n', at)) {
        visit(text.substr(at, end - at));
        at = end + 1;
    }
    return at;
}

}  // namespace

std::string onlyPixels(Bytes file) {
    const std::string_view text = textOf(file);
    std::string result;
    result.reserve(text.size());
    const size_t rest = forEachLine(text, [&](std::string_view line) {
        if (result.empty() || !line.starts_with('#')) result.append(line).append("\n");
    });
    return result.append(text.substr(rest));
}

std::string comment(Bytes file) {
    std::string result;
    forEachLine(textOf(file), [&](std::string_view line) {
        if (line.starts_with(kMark)) result += line.substr(kMark.size());
    });
    return result;
}

std::string withComment(Bytes file, const std::string& comment) {
    constexpr size_t kPiece = 120 - kMark.size();
    const std::string_view text = textOf(file);
    const size_t second = text.find('\n') + 1;
    std::string result(text.substr(0, second));
    for (size_t done = 0; done < comment.size(); done += kPiece)
        result.append(kMark).append(comment, done, kPiece).append("\n");
    return result.append(text.substr(second));
}

}  // namespace lobe::codec::hdr
