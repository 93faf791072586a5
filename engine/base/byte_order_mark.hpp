#pragma once

#include <string>

namespace lobe {

/// UTF-8 text without the mark that some editors put before it, which GLSL compilers take for code.
inline std::string withoutByteOrderMark(std::string text) {
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

}  // namespace lobe
