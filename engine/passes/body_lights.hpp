/// The scene's lights with a body as texture buffers, relative to the eye.
#pragma once

#include <array>
#include <vector>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "passes/light_atlas.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

class BodyLights {
public:
    BodyLights(const Scene& scene, const FramePlan& plan);

    /// Positions are made relative to the eye in double and sent. `frame`: number of the jittered frame.
    void update(const View& view, int frame);

    /// Texture units from `firstUnit` on, and every uniform of these lights that the program uses: all
    /// lights, and `points` on each. Returns the first free unit.
    int bind(const gl::Program& program, int firstUnit, int points) const;

    /// The part of them that one draw adds: lights [first, end) of a type, and points [from, to) of `points`.
    static void setLights(const gl::Program& program, LightType type, int first, int end);
    static void setPoints(const gl::Program& program, int from, int to, int points);

    /// Those of a type that cast shadows, in the order of their slots.
    std::vector<const Light*> casting(LightType type) const;

    int count(LightType type) const { return static_cast<int>(lights(type).size()); }

private:
    static constexpr size_t kTypes = 4;
    const std::vector<const Light*>& lights(LightType type) const {
        return lights_[static_cast<size_t>(type) - static_cast<size_t>(LightType::rect)];
    }
    std::array<std::vector<const Light*>, kTypes> lights_;
    std::array<bool, kTypes> shadows_{};  ///< whether lights of the type that cast shadows say so
    std::array<gl::TextureBuffer, kTypes> buffers_;
    LightAtlas images_;
    bool hasImages_;
    int frames_;  ///< that are jittered
    int frame_ = 0;
};

}  // namespace lobe
