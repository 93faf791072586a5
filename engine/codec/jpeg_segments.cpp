#include "codec/jpeg_segments.hpp"

#include <algorithm>
#include <functional>

namespace lobe::codec::jpeg {
namespace {

constexpr uint32_t kStartOfScan = 0xda;
constexpr uint32_t kComment = 0xfe;
constexpr uint32_t kApp0 = 0xe0;   // JFIF
constexpr uint32_t kApp14 = 0xee;  // Adobe
constexpr uint32_t kApp15 = 0xef;
constexpr size_t kStart = 2;  // after the marker that starts the image

struct Segment {
    uint32_t marker = 0;
    std::string_view data;
    std::string_view whole;
};

/// Every segment before the first scan; returns where that begins, or where the file stops being segments.
size_t forEachSegment(Bytes file, const std::function<void(const Segment&)>& visit) {
    const std::string_view text = textOf(file);
    size_t at = kStart;
    for (;;) {
        const auto marker = bigEndian16(file, at);
        const auto length = bigEndian16(file, at + 2);
        if (!marker || !length || *marker < 0xff01 || *marker == (0xff00U | kStartOfScan) || *length < 2)
            return at;
        if (*marker == 0xffff) {  // fill
            ++at;
            continue;
        }
        const std::string_view whole = text.substr(at, size_t{*length} + 2);
        visit({*marker & 0xffU, whole.substr(4), whole});
        at += whole.size();
    }
}

}  // namespace

std::string onlyPixels(Bytes file) {
    const std::string_view text = textOf(file);
    std::string result(text.substr(0, kStart));
    result.reserve(file.size());
    const size_t scan = forEachSegment(file, [&](const Segment& segment) {
        const bool application = segment.marker >= kApp0 && segment.marker <= kApp15;
        const bool colour = segment.marker == kApp0 || segment.marker == kApp14;
        if (segment.marker != kComment && (!application || colour)) result += segment.whole;
    });
    return result.append(text.substr(std::min(scan, text.size())));
}

std::string comment(Bytes file) {
    std::string result;
    forEachSegment(file, [&](const Segment& segment) {
        if (segment.marker == kComment) result += segment.data;
    });
    return result;
}

std::string withComment(Bytes file, const std::string& comment) {
    constexpr size_t kLongest = 65'533;  // the length of a segment counts its own two bytes
    const std::string_view text = textOf(file);
    size_t at = kStart;  // after JFIF's segment, which has to be first
    forEachSegment(file, [&](const Segment& segment) {
        if (segment.marker == kApp0 && at == kStart) at += segment.whole.size();
    });
    std::string result(text.substr(0, at));
    for (size_t done = 0; done < comment.size(); done += kLongest) {
        const std::string piece = comment.substr(done, kLongest);
        appendBigEndian16(result, 0xff00U | kComment);
        appendBigEndian16(result, static_cast<uint32_t>(piece.size() + 2));
        result += piece;
    }
    return result.append(text.substr(at));
}

}  // namespace lobe::codec::jpeg
