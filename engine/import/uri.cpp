#include "import/uri.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "import/refuse.hpp"

namespace lobe {

namespace fs = std::filesystem;

namespace {

constexpr uint64_t kLargestFile = uint64_t{4} << 30;  // what GLB can say of itself

int hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// False if a % is not followed by two hexadecimal digits.
bool decodePercent(std::string_view text, std::string& decoded) {
    decoded.clear();
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hexDigit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hexDigit(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            return false;
        }
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return true;
}

std::array<int, 256> base64Values() {
    std::array<int, 256> values{};
    values.fill(-1);
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < digits.size(); ++i) {
        values[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
    }
    return values;
}

/// False for a foreign character, or a length that no encoder writes.
bool decodeBase64(std::string_view text, std::vector<std::byte>& bytes) {
    static const std::array<int, 256> kValues = base64Values();
    for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return false;
    }
    bytes.clear();
    bytes.reserve(text.size() / 4 * 3 + 2);
    uint32_t buffered = 0;
    int bits = 0;
    for (const char c : text) {
        const int value = kValues[static_cast<unsigned char>(c)];
        if (value < 0) {
            return false;
        }
        buffered = (buffered << 6) | static_cast<uint32_t>(value);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<std::byte>((buffered >> bits) & 0xffU));
        }
    }
    return true;
}

/// RFC 3986: a scheme is a letter, then letters, digits, + - . up to the colon.
bool hasScheme(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon == 0 ||
        std::isalpha(static_cast<unsigned char>(uri[0])) == 0) {
        return false;
    }
    return std::all_of(uri.begin(), uri.begin() + static_cast<ptrdiff_t>(colon), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
    });
}

bool startsWithDotDot(const fs::path& relative) {
    return !relative.empty() && *relative.begin() == "..";
}

}  // namespace

bool isDataUri(std::string_view uri) {
    const std::string_view scheme = "data:";
    return uri.size() >= scheme.size() &&
           std::equal(scheme.begin(), scheme.end(), uri.begin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& file,
                                     const std::string& property) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        refuse(file, property, std::string(uri.substr(0, 100)), "a comma before the data of a data URI");
    }
    const std::string_view head = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    std::vector<std::byte> bytes;
    if (head.ends_with(";base64")) {
        std::string decoded;
        const bool encoded = body.find('%') != std::string_view::npos;
        if ((encoded && !decodePercent(body, decoded)) ||
            !decodeBase64(encoded ? std::string_view(decoded) : body, bytes)) {
            refuse(file, property, std::string(uri.substr(0, 100)), "valid base64 after the comma");
        }
        return bytes;
    }
    std::string decoded;
    if (!decodePercent(body, decoded)) {
        refuse(file, property, std::string(uri.substr(0, 100)), "two hexadecimal digits after each %");
    }
    bytes.reserve(decoded.size());
    std::transform(decoded.begin(), decoded.end(), std::back_inserter(bytes),
                   [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

fs::path resolveUri(const std::string& uri, const fs::path& folder, const std::string& file,
                    const std::string& property) {
    std::string decoded;
    if (!decodePercent(uri, decoded)) {
        refuse(file, property, uri, "two hexadecimal digits after each %");
    }
    if (decoded.empty() || decoded.find('\0') != std::string::npos) {
        refuse(file, property, "'" + uri + "'", "the name of a file");
    }
    if (hasScheme(uri) || hasScheme(decoded)) {
        refuse(file, property, uri, "a path relative to the scene file or a data URI, no other protocol");
    }
    if (decoded.find('\\') != std::string::npos) {
        refuse(file, property, uri, "a path with / between its folders");
    }
    const fs::path relative = fs::path(decoded).lexically_normal();
    if (relative.is_absolute() || startsWithDotDot(relative)) {
        refuse(file, property, uri, "a path inside the scene's folder");
    }
    fs::path path = (folder.empty() ? fs::path(".") : folder) / relative;
    std::error_code failed;
    const fs::path realFolder = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, failed);
    const fs::path realPath = failed ? fs::path() : fs::weakly_canonical(path, failed);
    if (failed) {
        refuse(file, property, uri, "a file that can be opened (" + failed.message() + ")");
    }
    if (startsWithDotDot(realPath.lexically_relative(realFolder))) {
        refuse(file, property, uri, "a path inside the scene's folder (a symbolic link leads out of it)");
    }
    return path;
}

std::string readWholeFile(const fs::path& path, std::vector<std::byte>& bytes) {
    // Not blocking, so that a named pipe is told apart from a file instead of waited for.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        return std::strerror(errno);
    }
    struct stat status {};
    std::string reason;
    if (::fstat(descriptor, &status) != 0) {
        reason = std::strerror(errno);
    } else if (S_ISDIR(status.st_mode)) {
        reason = "is a folder";
    } else if (!S_ISREG(status.st_mode)) {
        reason = "is no regular file";
    } else if (static_cast<uint64_t>(status.st_size) > kLargestFile) {
        reason = "is larger than 4 GiB";
    } else {
        bytes.resize(static_cast<size_t>(status.st_size));
        size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t got = ::read(descriptor, bytes.data() + done, bytes.size() - done);
            if (got < 0 && errno == EINTR) {
                continue;
            }
            if (got <= 0) {
                reason = got < 0 ? std::strerror(errno) : "became shorter while it was read";
                break;
            }
            done += static_cast<size_t>(got);
        }
    }
    ::close(descriptor);
    return reason;
}

std::vector<std::byte> readReferencedFile(const fs::path& path, const std::string& uri,
                                          const std::string& file, const std::string& property) {
    std::vector<std::byte> bytes;
    const std::string reason = readWholeFile(path, bytes);
    if (!reason.empty()) {
        refuse(file, property, uri, "a readable file (" + reason + ")");
    }
    return bytes;
}

}  // namespace lobe
