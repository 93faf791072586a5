/// Where a scene may read from: its own folder and what lies below, and data URIs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lobe {

bool isDataUri(std::string_view uri);

/// The bytes of a data URI, base64 or percent-encoded. Throws InputError.
std::vector<std::byte> decodeDataUri(std::string_view uri, const std::string& file,
                                     const std::string& property);

/// The file that a relative URI names. Refuses (InputError) other protocols, absolute paths, backslashes, and
/// whatever leaves `folder`: by "..", percent-encoded or not, or through symbolic links.
std::filesystem::path resolveUri(const std::string& uri, const std::filesystem::path& folder,
                                 const std::string& file, const std::string& property);

/// A whole regular file. Throws InputError "FILE: PROPERTY: ..." for what is missing, no file, or over 4 GiB.
std::vector<std::byte> readReferencedFile(const std::filesystem::path& path, const std::string& uri,
                                          const std::string& file, const std::string& property);

/// A whole regular file. Returns the reason instead of throwing: empty on success.
std::string readWholeFile(const std::filesystem::path& path, std::vector<std::byte>& bytes);

}  // namespace lobe
