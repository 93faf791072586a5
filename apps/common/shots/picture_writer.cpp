#include "picture_writer.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "image/tone.hpp"
#include "output_name.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;

/// A folder that only this process can look into, and that goes away with all that is in it.
class PrivateFolder {
public:
    PrivateFolder() {
        std::error_code failed;
        const fs::path parent = fs::temp_directory_path(failed);
        std::string pattern = ((failed ? fs::path("/tmp") : parent) / "lobe-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw OutputError(pattern + ": temporary folder: can't be made: " + std::strerror(errno));
        path_ = pattern;
    }
    ~PrivateFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    PrivateFolder(const PrivateFolder&) = delete;
    PrivateFolder& operator=(const PrivateFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

void copyToStandardOutput(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw OutputError(std::string("standard output: can't be written: ") + std::strerror(errno));
}

void writeTo(const fs::path& file, const Settings& settings, const Image& image,
             const std::map<std::string, std::string>& metadata, ImageFiles& files) {
    WriteOptions options;
    options.metadata = metadata;
    options.exrPrecision =
        settings.get("exr_precision") == "half" ? ExrPrecision::half : ExrPrecision::single;
    options.jpegQuality = settings.get("jpeg_quality").get<int>();
    const std::vector<std::string>& linear = ImageFiles::linearExtensions();
    if (std::find(linear.begin(), linear.end(), lowerExtension(file)) != linear.end())
        return files.write(file, image, options);
    const Background background = backgroundOf(settings);
    const auto exposure = static_cast<float>(settings.get("exposure").get<double>());
    files.write(file,
                toDisplay(image, exposure, toneMappingOf(settings), background.transparent, background.color),
                options);
}

}  // namespace

bool isConstant(const Image& image) {
    std::vector<size_t> colour;
    for (size_t c = 0; c < image.channelCount(); ++c)
        if (image.channels[c] == "R" || image.channels[c] == "G" || image.channels[c] == "B")
            colour.push_back(c);
    if (colour.empty())
        for (size_t c = 0; c < image.channelCount(); ++c)
            colour.push_back(c);
    for (size_t at = 0; at < image.values.size(); at += image.channelCount())
        for (const size_t c : colour)
            if (image.values[at + c] != image.values[c]) return false;
    return image.pixelCount() > 1;
}

void writePicture(const Shot& shot, const Image& image, const std::map<std::string, std::string>& metadata,
                  ImageFiles& files) {
    if (shot.output != "-") return writeTo(shot.output, *shot.settings, image, metadata, files);
    const PrivateFolder folder;
    writeTo(folder.path() / "picture.png", *shot.settings, image, metadata, files);
    copyToStandardOutput(folder.path() / "picture.png");
}

}  // namespace lobe::app
