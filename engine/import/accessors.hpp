/// Typed data out of a document's buffers: any component type, interleaved, normalised, sparse.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/document.hpp"

namespace lobe {

/// Byte ranges of every accessor and of its sparse parts against their buffer views. Throws InputError.
void checkAccessors(const Document& document);

size_t componentCount(const tinygltf::Accessor& accessor);

/// What an accessor must be at the place where it is used.
struct AccessorUse {
    std::string property;  ///< that refers to it: "meshes[0].primitives[0].attributes.POSITION"
    int type;              ///< TINYGLTF_TYPE_*
    std::vector<int> componentTypes;
    enum class Normalized : uint8_t { either, integersMust, never } normalized = Normalized::either;
    bool mayBeCompressed = false;  ///< the accessor only describes what another decoder yields
};

/// Throws InputError that names the use, the accessor and what it is.
void checkUse(const Document& document, int accessor, const AccessorUse& use);

/// All components one after another, normalised integers as fractions.
std::vector<float> readFloats(const Document& document, int accessor);
void readFloats(const Document& document, int accessor, float* out);

/// Integer components (never normalised): indices, joints.
std::vector<uint32_t> readIntegers(const Document& document, int accessor);

/// Index of the first value that is NaN or infinite, or `count`.
size_t firstNonFinite(const float* values, size_t count);

/// readFloats() that refuses NaN and infinity.
void readFiniteFloats(const Document& document, int accessor, float* out);

}  // namespace lobe
