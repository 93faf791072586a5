/// Light of the environment on the GPU: the map itself, what is prefiltered from it for each model, and
/// directions drawn from it.
#pragma once

#include <map>
#include <string>

#include "environment/prefiltered.hpp"
#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace lobe {

class EnvironmentLight {
public:
    /// Makes and uploads what the plan needs; prefiltered maps are kept on disk between runs. Where
    /// `earlier`, of a scene with the same images, has it already, it is taken from there; with `borrow` also
    /// if it was made for other lobes of the same models, in whose place they stand then.
    EnvironmentLight(const Scene& scene, const FramePlan& plan, EnvironmentLight* earlier = nullptr,
                     bool borrow = false);
    bool borrowed() const { return borrowed_; }

    /// `frame`: number of the jittered frame.
    void update(int frame) { frame_ = frame; }

    /// Texture units of its own, and every uniform of pass/environment.glsl that the program, of one model,
    /// uses. `samples`: directions in all. Returns `firstUnit`, which stays free.
    int bind(const gl::Program& program, int firstUnit, const std::string& model, int samples) const;
    /// What is seen behind surfaces.
    void bindBackground(const gl::Program& program, int unit) const;

    /// The part that one draw adds: pairs [first, end) of directions.
    static void setPairs(const gl::Program& program, int first, int end);
    /// A pair is a direction drawn by brightness and one drawn by the lobe.
    static int pairsOf(int samples) { return samples / 2 > 1 ? samples / 2 : 1; }

private:
    struct Prefiltered {
        environment::Prefiltered layout;  ///< without texels
        gl::Texture texture;
    };
    int bindMap(const gl::Program& program, int unit, const gl::Texture& map) const;

    std::string made_, lobes_;  ///< what decides all that is uploaded
    bool borrowed_ = false;
    int frame_ = 0;
    glm::mat3 mapFromWorld_{1.0F};
    glm::vec3 scale_{1.0F};
    std::map<std::string, Prefiltered> prefiltered_;
    std::vector<glm::vec3> harmonics_;
    gl::Texture map_, background_;
    gl::TextureBuffer directions_;
};

}  // namespace lobe
