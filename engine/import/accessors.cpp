#include "import/accessors.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "import/refuse.hpp"

namespace lobe {

namespace {

/// Zeros stand for an absent buffer view; they cost memory that no file pays for.
constexpr uint64_t kMostZeroBytes = uint64_t{1} << 28;

size_t componentBytes(int componentType) {
    return static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)));
}

/// Bytes of an element; matrix columns start at multiples of four bytes.
struct Layout {
    size_t components;
    size_t rows;         ///< components a column
    size_t columnBytes;  ///< from column to column
    size_t elementBytes;
    size_t stride;
};

Layout layoutOf(const Document& document, const tinygltf::Accessor& accessor) {
    const size_t component = componentBytes(accessor.componentType);
    Layout layout{};
    layout.components = componentCount(accessor);
    layout.rows = layout.components;
    size_t columns = 1;
    if (accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 ||
        accessor.type == TINYGLTF_TYPE_MAT4) {
        columns = accessor.type == TINYGLTF_TYPE_MAT2 ? 2 : accessor.type == TINYGLTF_TYPE_MAT3 ? 3 : 4;
        layout.rows = columns;
    }
    layout.columnBytes = columns == 1 ? layout.rows * component : (layout.rows * component + 3) / 4 * 4;
    layout.elementBytes = (columns - 1) * layout.columnBytes + layout.rows * component;
    const size_t tight = columns * layout.columnBytes;
    const size_t given =
        accessor.bufferView < 0
            ? 0
            : document.model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    layout.stride = given == 0 ? tight : given;
    return layout;
}

void checkRange(const Document& document, const std::string& property, size_t bufferView, uint64_t offset,
                uint64_t count, uint64_t stride, uint64_t elementBytes, size_t componentSize) {
    const tinygltf::BufferView& view = document.model.bufferViews[bufferView];
    // count is below 2^32 and stride below 2^16, so this can't overflow; offset is below 2^53.
    const uint64_t end = offset + (count - 1) * stride + elementBytes;
    if (end > view.byteLength) {
        refuse(document.file, property,
               std::to_string(count) + " elements end at byte " + std::to_string(end) + " of " +
                   at("bufferViews", bufferView),
               "at most its byteLength " + std::to_string(view.byteLength));
    }
    if ((view.byteOffset + offset) % componentSize != 0) {
        refuse(document.file, property + ".byteOffset", std::to_string(offset),
               "a place in the buffer that is a multiple of the component's " +
                   std::to_string(componentSize) + " bytes");
    }
}

template<typename Component>
float toFloat(Component value, bool normalized) {
    if constexpr (std::is_same_v<Component, float>) {
        return value;
    } else {
        if (!normalized) {
            return static_cast<float>(value);
        }
        constexpr float kScale = 1.0f / static_cast<float>(std::numeric_limits<Component>::max());
        return std::max(static_cast<float>(value) * kScale, -1.0f);
    }
}

template<typename Component, typename Out, typename Convert>
void copyElements(const std::byte* from, const Layout& layout, size_t count, Out* out, Convert convert) {
    const size_t columns = layout.components / layout.rows;
    for (size_t element = 0; element < count; ++element) {
        for (size_t column = 0; column < columns; ++column) {
            const std::byte* source = from + element * layout.stride + column * layout.columnBytes;
            for (size_t row = 0; row < layout.rows; ++row) {
                Component value;
                std::memcpy(&value, source + row * sizeof(Component), sizeof value);
                *out++ = convert(value);
            }
        }
    }
}

void convertElements(const std::byte* from, int componentType, bool normalized, const Layout& layout,
                     size_t count, float* out) {
    const auto as = [&]<typename Component>(Component) {
        copyElements<Component>(from, layout, count, out,
                                [normalized](Component value) { return toFloat(value, normalized); });
    };
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            as(int8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            as(uint8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            as(int16_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            as(uint16_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            as(uint32_t{});
            break;
        default:
            if (layout.stride == layout.components * sizeof(float)) {
                std::memcpy(out, from, count * layout.stride);
            } else {
                as(float{});
            }
    }
}

void convertElements(const std::byte* from, int componentType, bool /*normalized*/, const Layout& layout,
                     size_t count, uint32_t* out) {
    const auto as = [&]<typename Component>(Component) {
        copyElements<Component>(from, layout, count, out,
                                [](Component value) { return static_cast<uint32_t>(value); });
    };
    switch (componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            as(uint8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            as(uint16_t{});
            break;
        default:
            as(uint32_t{});
            break;
    }
}

template<typename Out>
void readElements(const Document& document, int index, Out* out) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    const Layout layout = layoutOf(document, accessor);
    if (accessor.bufferView >= 0) {
        const std::byte* from =
            document.viewBytes(static_cast<size_t>(accessor.bufferView)).data() + accessor.byteOffset;
        convertElements(from, accessor.componentType, accessor.normalized, layout, accessor.count, out);
    } else {
        std::fill_n(out, accessor.count * layout.components, Out{0});
    }
    if (!accessor.sparse.isSparse) {
        return;
    }
    const auto& sparse = accessor.sparse;
    const auto count = static_cast<size_t>(sparse.count);
    Layout one{1, 1, 0, componentBytes(sparse.indices.componentType),
               componentBytes(sparse.indices.componentType)};
    std::vector<uint32_t> places(count);
    convertElements(document.viewBytes(static_cast<size_t>(sparse.indices.bufferView)).data() +
                        static_cast<size_t>(sparse.indices.byteOffset),
                    sparse.indices.componentType, false, one, count, places.data());
    Layout tight = layout;
    tight.stride = layout.components / layout.rows * layout.columnBytes;
    std::vector<Out> values(count * layout.components);
    convertElements(document.viewBytes(static_cast<size_t>(sparse.values.bufferView)).data() +
                        static_cast<size_t>(sparse.values.byteOffset),
                    accessor.componentType, accessor.normalized, tight, count, values.data());
    for (size_t i = 0; i < count; ++i) {
        if (places[i] >= accessor.count) {
            refuse(document.file, at("accessors", static_cast<size_t>(index), "sparse.indices") + at("", i),
                   std::to_string(places[i]), "an index below count " + std::to_string(accessor.count));
        }
        std::copy_n(values.data() + i * layout.components, layout.components,
                    out + places[i] * layout.components);
    }
}

std::string described(const tinygltf::Accessor& accessor) {
    static const char* const kComponents[] = {"int8", "uint8", "int16", "uint16", "int32", "uint32", "float"};
    const std::string type = accessor.type == TINYGLTF_TYPE_SCALAR ? "scalar"
                             : accessor.type < 16 ? "vec" + std::to_string(componentCount(accessor))
                                                  : "mat";
    return type + " of " + (accessor.normalized ? "normalized " : "") +
           kComponents[accessor.componentType - TINYGLTF_COMPONENT_TYPE_BYTE];
}

}  // namespace

size_t componentCount(const tinygltf::Accessor& accessor) {
    return static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
}

void checkAccessors(const Document& document) {
    for (size_t i = 0; i < document.model.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = document.model.accessors[i];
        const Layout layout = layoutOf(document, accessor);
        const size_t component = componentBytes(accessor.componentType);
        const std::string property = at("accessors", i);
        if (layout.stride < layout.elementBytes) {
            refuse(document.file, at("bufferViews", static_cast<size_t>(accessor.bufferView), "byteStride"),
                   std::to_string(layout.stride),
                   "at least the " + std::to_string(layout.elementBytes) + " bytes of an element of " +
                       property);
        }
        if (accessor.bufferView >= 0) {
            checkRange(document, property, static_cast<size_t>(accessor.bufferView), accessor.byteOffset,
                       accessor.count, layout.stride, layout.elementBytes, component);
        }
        const auto& sparse = accessor.sparse;
        if (!sparse.isSparse) {
            continue;
        }
        if (static_cast<size_t>(sparse.count) > accessor.count) {
            refuse(document.file, property + ".sparse.count", std::to_string(sparse.count),
                   "at most count " + std::to_string(accessor.count));
        }
        const size_t indexBytes = componentBytes(sparse.indices.componentType);
        const size_t tight = layout.components / layout.rows * layout.columnBytes;
        checkRange(document, property + ".sparse.indices", static_cast<size_t>(sparse.indices.bufferView),
                   static_cast<uint64_t>(sparse.indices.byteOffset), static_cast<uint64_t>(sparse.count),
                   indexBytes, indexBytes, indexBytes);
        checkRange(document, property + ".sparse.values", static_cast<size_t>(sparse.values.bufferView),
                   static_cast<uint64_t>(sparse.values.byteOffset), static_cast<uint64_t>(sparse.count),
                   tight, layout.elementBytes, component);
    }
}

void checkUse(const Document& document, int index, const AccessorUse& use) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    const bool integer = accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool normalizedFits =
        use.normalized == AccessorUse::Normalized::either ||
        (use.normalized == AccessorUse::Normalized::never ? !accessor.normalized
                                                          : !integer || accessor.normalized);
    const auto& types = use.componentTypes;
    if (accessor.type == use.type && normalizedFits &&
        std::find(types.begin(), types.end(), accessor.componentType) != types.end()) {
        const uint64_t most = kMostZeroBytes / (componentCount(accessor) * sizeof(float));
        if (accessor.bufferView < 0 && !use.mayBeCompressed && accessor.count > most) {
            refuse(document.file, at("accessors", static_cast<size_t>(index), "count"),
                   std::to_string(accessor.count),
                   "at most " + std::to_string(most) + " without a bufferView");
        }
        return;
    }
    std::string expected;
    for (const int type : types) {
        tinygltf::Accessor wanted;
        wanted.type = use.type;
        wanted.componentType = type;
        wanted.normalized =
            use.normalized == AccessorUse::Normalized::integersMust && type != TINYGLTF_COMPONENT_TYPE_FLOAT;
        expected += (expected.empty() ? "" : ", ") + described(wanted);
    }
    refuse(document.file, use.property,
           at("accessors", static_cast<size_t>(index)) + " is a " + described(accessor),
           "one of " + expected);
}

void readFloats(const Document& document, int accessor, float* out) {
    readElements(document, accessor, out);
}

std::vector<float> readFloats(const Document& document, int index) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    std::vector<float> values(accessor.count * componentCount(accessor));
    readFiniteFloats(document, index, values.data());
    return values;
}

std::vector<uint32_t> readIntegers(const Document& document, int index) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    std::vector<uint32_t> values(accessor.count * componentCount(accessor));
    readElements(document, index, values.data());
    return values;
}

size_t firstNonFinite(const float* values, size_t count) {
    constexpr uint32_t kExponent = 0x7f800000U;
    const auto nonFinite = [](float value) {
        uint32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        return (bits & kExponent) == kExponent;
    };
    constexpr size_t kBlock = 1024;
    for (size_t start = 0; start < count; start += kBlock) {
        const size_t end = std::min(count, start + kBlock);
        bool any = false;
        for (size_t i = start; i < end; ++i) {
            any |= nonFinite(values[i]);
        }
        if (any) {
            return static_cast<size_t>(std::find_if(values + start, values + end, nonFinite) - values);
        }
    }
    return count;
}

void readFiniteFloats(const Document& document, int index, float* out) {
    const tinygltf::Accessor& accessor = document.model.accessors[static_cast<size_t>(index)];
    readElements(document, index, out);
    const size_t count = accessor.count * componentCount(accessor);
    const size_t bad = firstNonFinite(out, count);
    if (bad < count) {
        refuse(document.file,
               at("accessors", static_cast<size_t>(index)) + ", element " +
                   std::to_string(bad / componentCount(accessor)),
               static_cast<double>(out[bad]), "finite numbers");
    }
}

}  // namespace lobe
