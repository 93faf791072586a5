#include "passes/renderer.hpp"

#include <chrono>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "gl/debug.hpp"
#include "gl/objects.hpp"
#include "gl/timer.hpp"
#include "math/random.hpp"
#include "passes/pass.hpp"
#include "passes/readback.hpp"

namespace lobe {
namespace {

/// Sample i of n within the pixel, relative to its centre: Hammersley's points, whose mean is the centre for
/// any power of two, so that the picture is not shifted. One sample is the centre.
glm::dvec2 jitter(int index, int count) {
    const double across = (index + 0.5) / count - 0.5;
    return {across, radicalInverse(2, static_cast<uint64_t>(index)) + 0.5 / count - 0.5};
}

}  // namespace

gl::ShaderLibrary shaderLibrary() {
    gl::ShaderLibrary library(shaderDirectory());
    for (const Brdf& brdf : loadedBrdfs())
        library.mount("brdf/" + brdf.name + ".glsl", brdf.file, brdf.glsl);
    return library;
}

Capabilities capabilitiesOf(const gl::ContextInfo& info) {
    Capabilities capabilities;
    capabilities.clipControl = info.clipControl;
    capabilities.anisotropicFilter = info.anisotropicFilter;
    capabilities.softwareRasteriser = info.software;
    capabilities.reliableTimers = info.reliableTimers;
    capabilities.maxTextureSize = info.maxTextureSize;
    capabilities.maxColorAttachments = std::min(info.maxColorAttachments, info.maxDrawBuffers);
    capabilities.maxTextureBufferTexels = info.maxTextureBufferTexels;
    capabilities.maxArrayLayers = info.maxArrayLayers;
    return capabilities;
}

struct Renderer::State {
    explicit State(gl::Context& glContext)
        : context(glContext), capabilities(capabilitiesOf(glContext.info())), programs(shaderLibrary()) {}

    /// All that belongs to one scene and one set of options.
    struct SceneState {
        SceneState(std::shared_ptr<const Scene> sceneToDraw, const RenderOptions& renderOptions,
                   FramePlan framePlan, const Capabilities& capabilities, ProgramCache& programs,
                   EnvironmentLight* earlier, bool borrow)
            : scene(std::move(sceneToDraw)),
              options(renderOptions),
              plan(std::move(framePlan)),
              targets(plan, renderOptions.width, renderOptions.height),
              tables(*scene, plan),
              surfaces(*scene, plan, capabilities, programs, tables),
              lights(*scene, plan),
              bodies(*scene, plan),
              environment(*scene, plan, earlier, borrow),
              inputs(*scene, plan, tables),
              rays(plan.rays ? RayScene(*scene, capabilities.maxTextureBufferTexels) : RayScene()),
              shadowMaps(*scene, plan, lights, bodies),
              resources{*scene,      plan,   programs, targets,    surfaces, lights, bodies,
                        environment, inputs, rays,     shadowMaps, {},       1} {
            makePasses();
        }

        void makePasses() {
            frame.clear();
            data.reset();
            accumulate.reset();
            surfaces.forgetVariants();
            for (const PlannedPass& planned : plan.passes) {
                if (planned.name == "peel") continue;  // run by the forward pass
                const gl::DebugScope scope("preparing " + planned.name);
                auto pass = makePass(planned, resources);
                pass->prepare();
                if (planned.name == "aov")
                    data = std::move(pass);
                else if (planned.name == "accumulate")
                    accumulate = std::move(pass);
                else
                    frame.push_back(std::move(pass));
            }
        }
        std::shared_ptr<const Scene> scene;
        RenderOptions options;
        FramePlan plan;
        Targets targets;
        BrdfTableBuffer tables;
        SurfaceDraws surfaces;
        LightBuffers lights;
        BodyLights bodies;
        EnvironmentLight environment;
        ScreenInputs inputs;
        RayScene rays;
        ShadowMaps shadowMaps;
        FrameResources resources;
        std::vector<std::unique_ptr<Pass>> frame;
        std::unique_ptr<Pass> accumulate, data;
    };

    /// Whether what was uploaded of the images can be used for `scene` as well.
    bool hasImagesOf(const Scene& scene, const Quality& quality) const {
        if (!current || current->plan.quality.textureBits != quality.textureBits) return false;
        if (current->scene.get() == &scene) return true;
        return std::equal(current->scene->images.begin(), current->scene->images.end(), scene.images.begin(),
                          scene.images.end(), [](const Bitmap& a, const Bitmap& b) {
                              return a.width == b.width && a.height == b.height && a.channels == b.channels &&
                                     a.type == b.type && a.data == b.data;
                          });
    }

    void requireSize(int width, int height) const {
        const int most = capabilities.maxTextureSize;
        if (width > most || height > most)
            throw UsageError("resolution " + std::to_string(width) + "x" + std::to_string(height) +
                             "; expected at most " + std::to_string(most) + " a side, the driver's limit");
    }

    void clearPictures() const {
        const FramePlan& plan = current->plan;
        const float black[] = {0.0f, 0.0f, 0.0f, 0.0f};
        std::vector<std::string> pictures = {"radiance"};
        for (const std::string& name : plan.contributionTargets)
            pictures.push_back("contribution." + name);
        for (const std::string& picture : pictures) {
            if (std::find(plan.gbufferTargets.begin(), plan.gbufferTargets.end(), picture) !=
                plan.gbufferTargets.end())
                continue;  // cleared with the G-buffer
            glBindFramebuffer(GL_FRAMEBUFFER, current->targets.single(picture));
            glClearBufferfv(GL_COLOR, 0, black);
        }
    }

    void clearAccumulated() const {
        const float black[] = {0.0f, 0.0f, 0.0f, 0.0f};
        for (const Channel& channel : current->plan.channels) {
            const std::string target = "accumulated." + channel.name;
            if (!current->targets.has(target)) continue;
            glBindFramebuffer(GL_FRAMEBUFFER, current->targets.single(target));
            glClearBufferfv(GL_COLOR, 0, black);
        }
    }

    void setDepthRange() const {
        if (!capabilities.clipControl) return;
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    }

    /// The view's reversed depth in 0..1, or GL's own -1..1 with 1 far where clip control is absent.
    View adapted(View view) const {
        if (current->plan.reversedDepth) return view;
        glm::dmat4 flip(1.0);
        flip[2][2] = -2.0;
        flip[3][2] = 1.0;
        view.clipFromRelative = flip * view.clipFromRelative;
        return view;
    }

    gl::Context& context;
    Capabilities capabilities;
    ProgramCache programs;
    std::unique_ptr<SceneState> current;
};

Renderer::Renderer(gl::Context& context) : state_(std::make_unique<State>(context)) {}
Renderer::~Renderer() = default;

void Renderer::setScene(std::shared_ptr<const Scene> scene, const RenderOptions& options, bool borrow) {
    state_->requireSize(options.width, options.height);
    if (options.quality.fresnel == FresnelEquations::schlick)
        scene = std::make_shared<const Scene>(withSchlick(*scene));
    FramePlan plan = planFrame(summarise(*scene), options.quality, state_->capabilities, options.aovs);
    GpuTextures kept(*scene, options.quality.textureBits, state_->capabilities);
    std::optional<EnvironmentLight> environment;
    if (state_->hasImagesOf(*scene, options.quality)) {
        kept.adopt(std::move(state_->current->surfaces.textures()));
        environment = std::move(state_->current->environment);
    }
    state_->current.reset();
    state_->current =
        std::make_unique<State::SceneState>(std::move(scene), options, std::move(plan), state_->capabilities,
                                            state_->programs, environment ? &*environment : nullptr, borrow);
    state_->current->surfaces.textures().adopt(std::move(kept));
    gl::checkErrors("setting up the scene");
}

bool Renderer::borrowed() const {
    return state_->current->environment.borrowed();
}

void Renderer::resize(int width, int height) {
    state_->requireSize(width, height);
    State::SceneState& current = *state_->current;
    current.options.width = width;
    current.options.height = height;
    current.targets = Targets(current.plan, width, height);
    current.makePasses();
    gl::checkErrors("changing the size");
}

void Renderer::onCompile(std::function<void(const std::string&)> callback) {
    state_->programs.onCompile(std::move(callback));
}

const FramePlan& Renderer::plan() const {
    return state_->current->plan;
}

Picture Renderer::render(const Camera& camera, const RenderRun& how) {
    State::SceneState& current = *state_->current;
    const gl::DebugScope frameScope("rendering " + current.scene->name);
    const auto run = [](Pass& pass, const View& view) {
        const gl::DebugScope scope(pass.name());
        pass.run(view);
    };
    const RenderOptions& options = current.options;
    const auto start = std::chrono::steady_clock::now();
    gl::PassTimer timer(state_->capabilities.reliableTimers);
    const auto mark = [&](const std::string& name) {
        if (options.timePasses) timer.mark(name);
    };
    const auto stopped = [&] { return how.stop != nullptr && how.stop->load(std::memory_order_relaxed); };
    const int samples = how.samples > 0 ? how.samples : current.plan.samples;
    current.resources.samples = samples;
    if (options.timePasses) timer.start();

    state_->setDepthRange();
    glViewport(0, 0, options.width, options.height);
    glDisable(GL_DITHER);
    const View center = state_->adapted(makeView(camera, options.width, options.height));
    // With several samples, data AOVs need a frame of their own at the pixel centres.
    if (current.data && current.plan.samples > 1) {
        for (const auto& pass : current.frame)
            if (pass->name() == "gbuffer") run(*pass, center);
        run(*current.data, center);
        mark("aov");
    }
    current.resources.remarks.clear();
    if (current.accumulate) state_->clearAccumulated();
    for (int sample = 0; sample < samples; ++sample) {
        const View view =
            state_->adapted(makeView(camera, options.width, options.height, jitter(sample, samples)));
        current.lights.update(view);
        current.bodies.update(view, sample);
        current.environment.update(sample);
        mark("lights");
        state_->clearPictures();
        for (const auto& pass : current.frame) {
            run(*pass, view);
            mark(pass->name());
            if (stopped()) return {};
        }
        if (current.accumulate) {
            run(*current.accumulate, view);
            mark("accumulate");
        }
    }
    if (current.data && current.plan.samples == 1) {
        run(*current.data, center);
        mark("aov");
    }
    Picture picture;
    picture.image = readPicture(current.plan, current.targets, center, options.aovs);
    picture.warnings.assign(current.resources.remarks.begin(), current.resources.remarks.end());
    mark("readback");
    gl::checkErrors("rendering");
    if (options.timePasses)
        for (const auto& [name, milliseconds] : timer.finish())
            picture.passTimes.push_back({name, milliseconds});
    picture.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

}  // namespace lobe
