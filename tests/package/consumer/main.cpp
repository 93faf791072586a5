// A program outside the project: draws a white Lambert square under a light of irradiance pi, whose radiance
// is one.
#include <cmath>
#include <iostream>
#include <memory>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "passes/renderer.hpp"

int main() {
    try {
        std::cout << "shaders " << std::filesystem::canonical(lobe::shaderDirectory()).string() << "\n"
                  << "worker "
                  << std::filesystem::canonical(lobe::workerProgram("lobe-image-worker")).string() << "\n"
                  << "page " << std::filesystem::canonical(lobe::pageDirectory()).string() << "\n";
        const auto context = lobe::gl::Context::create();

        lobe::Scene scene;
        const lobe::Brdf& lambert = lobe::requireBrdf("lambert");
        lobe::Material white;
        white.brdf = lambert.name;
        white.values.assign(lambert.defaults().size(), 1.0);
        white.textures.resize(lambert.parameters.size());
        white.textureChannels.resize(lambert.parameters.size());
        scene.materials.push_back(white);
        lobe::Primitive square;
        square.material = 0;
        square.positions = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
        square.normals.assign(4, glm::vec3(0, 0, 1));
        square.indices = {0, 1, 2, 0, 2, 3};
        scene.primitives.push_back(square);
        scene.instances.push_back({0, glm::dmat4(1.0), "square"});
        lobe::Light light;
        light.type = lobe::LightType::directional;
        light.direction = {0, 0, -1};
        light.intensity = glm::dvec3(3.14159265358979);
        scene.lights.push_back(light);

        lobe::RenderOptions options;
        options.width = options.height = 16;
        options.quality = {.samples = 1, .gbufferBits = 32};
        options.aovs = {lobe::Aov::radiance};
        lobe::Renderer renderer(*context);
        renderer.setScene(std::make_shared<lobe::Scene>(scene), options);
        const auto picture = renderer.render(lobe::lookAt({0, 0, 3}, {0, 0, 0}, 0.7)).image;
        const float radiance = picture.pixel(8, 8)[0];
        std::cout << "radiance " << radiance << "\n";
        return std::abs(radiance - 1.0f) <= 1e-6f ? 0 : 1;
    } catch (const lobe::Error& error) {
        std::cerr << error.what() << "\n";
        return static_cast<int>(error.exitCode());
    }
}
