#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "import/import.hpp"
#include "scene/load_protocol.hpp"

namespace lobe {

Message serveImport(const Message& request) {
    const auto [file, options] = readLoadRequest(request);
    std::vector<Brdf> models;
    std::transform(options.brdfs.begin(), options.brdfs.end(), std::back_inserter(models), brdfFromSource);
    setLoadedBrdfs(std::move(models));
    Imported imported = importGltf(file, options);
    std::vector<PackedImage> images;
    size_t total = 0;
    for (const EncodedImage& image : imported.images) {
        images.push_back({image.name, total, image.bytes.size(), image.fallback});
        total += image.bytes.size();
    }
    SharedMemory pictures(total);
    for (size_t i = 0; i < images.size(); ++i) {
        const std::vector<std::byte>& bytes = imported.images[i].bytes;
        std::copy(bytes.begin(), bytes.end(),
                  pictures.bytes().begin() + static_cast<ptrdiff_t>(images[i].offset));
    }
    return writeLoadReply(imported.scene, images, std::move(pictures));
}

}  // namespace lobe
