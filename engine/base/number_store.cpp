#include "base/number_store.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <span>

#include "base/atomic_file.hpp"
#include "base/content_hash.hpp"
#include "base/error.hpp"

namespace lobe {
namespace {

/// Before the facts, which come before the values.
struct Header {
    uint64_t facts = 0, values = 0;
    std::array<char, 16> check{};  ///< a hash of kind, version, key, facts and values
};

template<class Number>
std::streamsize bytesOf(const std::vector<Number>& numbers) {
    return static_cast<std::streamsize>(numbers.size() * sizeof(Number));
}

template<class Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
    const size_t at = bytes.size();
    bytes.resize(at + numbers.size() * sizeof(Number));
    if (!numbers.empty()) std::memcpy(bytes.data() + at, numbers.data(), numbers.size() * sizeof(Number));
}

template<class Number>
bool read(std::ifstream& file, std::vector<Number>& numbers) {
    return static_cast<bool>(file.read(reinterpret_cast<char*>(numbers.data()), bytesOf(numbers)));
}

}  // namespace

std::string NumberStore::checkOf(const std::string& key, const KeptNumbers& numbers) const {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(kind_)));
    hash.add(std::as_bytes(std::span(&version_, 1)));
    hash.add(std::as_bytes(std::span(key)));
    hash.add(std::as_bytes(std::span(numbers.facts)));
    hash.add(std::as_bytes(std::span(numbers.values)));
    return hash.hex();
}

std::optional<KeptNumbers> NumberStore::find(const std::string& key) const {
    if (folder_.empty()) return {};
    std::error_code failed;
    const uintmax_t size = std::filesystem::file_size(fileOf(key), failed);
    std::ifstream file(fileOf(key), std::ios::binary);
    std::array<char, sizeof(Header)> head{};
    if (failed || !file.read(head.data(), head.size())) return {};
    Header header;
    std::memcpy(&header, head.data(), sizeof(header));
    // Counts that the file is too short for are not asked memory for.
    if (header.facts > size / sizeof(double) || header.values > size / sizeof(float) ||
        size != sizeof(Header) + header.facts * sizeof(double) + header.values * sizeof(float))
        return {};
    KeptNumbers numbers{std::vector<double>(header.facts), std::vector<float>(header.values)};
    if (!read(file, numbers.facts) || !read(file, numbers.values)) return {};
    if (std::string(header.check.begin(), header.check.end()) != checkOf(key, numbers)) return {};
    return numbers;
}

void NumberStore::keep(const std::string& key, const KeptNumbers& numbers) const {
    if (folder_.empty()) return;
    Header header{numbers.facts.size(), numbers.values.size(), {}};
    checkOf(key, numbers).copy(header.check.data(), header.check.size());
    std::string bytes(sizeof(header), '\0');
    std::memcpy(bytes.data(), &header, sizeof(header));
    append(bytes, numbers.facts);
    append(bytes, numbers.values);
    try {
        writeAtomically(fileOf(key), bytes);
    } catch (const Error&) {
        return;  // a full or read-only disk costs time, nothing else
    }
}

}  // namespace lobe
