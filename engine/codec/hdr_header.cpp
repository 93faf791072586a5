#include "codec/hdr_header.hpp"

namespace lobe::codec::hdr {
namespace {

constexpr std::string_view kMark = "#lobe ";

}  // namespace

std::string comment(Bytes file) {
    std::string result;
    std::string_view rest = textOf(file);
    for (size_t end = rest.find('\n'); end != std::string_view::npos && end > 0; end = rest.find('\n')) {
        const std::string_view line = rest.substr(0, end);
        if (line.starts_with(kMark)) result += line.substr(kMark.size());
        rest.remove_prefix(end + 1);
    }
    return result;
}

std::string withComment(Bytes file, const std::string& comment) {
    constexpr size_t kPiece = 100;
    const std::string_view text = textOf(file);
    const size_t second = text.find('\n') + 1;
    std::string result(text.substr(0, second));
    for (size_t done = 0; done < comment.size(); done += kPiece)
        result.append(kMark).append(comment, done, kPiece).append("\n");
    return result.append(text.substr(second));
}

}  // namespace lobe::codec::hdr
