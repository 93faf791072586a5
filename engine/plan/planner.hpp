/// How planFrame() decides; for the files of this folder only. What each step decides is in
/// plan_channels.cpp, plan_lights.cpp and plan_passes.cpp.
#pragma once

#include <map>
#include <string>

#include "plan/plan.hpp"

namespace lobe {

/// "1 light", "2 lights".
std::string plural(int count, const std::string& noun);

/// Whether punctual lights show on surfaces of this model.
bool scattersLight(const std::string& model);

/// Whether light of bodies that surfaces of this model reflect is known without points on them.
bool hasClosedForm(const SceneSummary& scene, const std::string& model);

/// Bytes a pixel of a format, by its OpenGL name.
int bytesOfFormat(const std::string& format);

/// "aov.depth" as a define can be called: "AOV_DEPTH".
std::string defineName(std::string name);

class Planner {
public:
    using Defines = std::map<std::string, std::string>;

    Planner(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
            const AovSet& aovs)
        : scene_(summary), capabilities_(capabilities), aovs_(aovs) {
        plan_.quality = quality;
    }
    FramePlan plan();

private:
    bool wants(Aov aov) const { return aovs_.contains(aov); }
    void leaveOut(const std::string& kind, const std::string& name, const std::string& reason) {
        plan_.leftOut.push_back({kind, name, reason});
    }
    void addChannel(const std::string& name, const std::string& format, const std::string& holds,
                    const std::string& reason) {
        plan_.channels.push_back({name, format, bytesOfFormat(format), holds, reason});
    }
    void addTarget(const std::string& name, const std::string& format, const std::string& holds,
                   const std::string& reason) {
        addChannel(name, format, holds, reason);
        plan_.gbufferTargets.push_back(name);
    }
    void planModels();
    void planGeometryChannels();
    void planNormal();
    void planGeometricNormal();
    void planTangent();
    void planTable();
    void planMaterialId();
    void planParameters();
    void planRadiance();
    void requireFit(const char* type, int count, int texelsEach) const;
    /// One loop of a fragment shader runs over all lights that reach everything; software drivers end loops
    /// at 65535.
    void requireForwardLoop(const char* type, int global) const;
    void planShadows();
    void planBodyShadows();
    /// Why no light of a type casts shadows here; empty if some do.
    std::string whyNoShadow(int casting) const;
    /// Why rays cannot be had on this driver; empty if they can.
    std::string whyNoRays() const;
    /// Throws ContextError if they cannot.
    void requireRays();
    bool prefersMaps() const;
    std::string mapsReason() const;
    PlannedShadow shadowMethod(LightType type, int lights, int casting);
    /// For programs that include shadow/rays.glsl; where any does, FramePlan::rays is to be set.
    void rayDefines(Defines& defines) const;
    void noteRays();
    void planShadowMaps();
    void planShadowMapSize();
    void shadowMapDefines(Defines& defines, LightType type) const;
    void planReach();
    /// Lights without range reach every pixel and stay outside the clusters.
    void planLights();
    Defines commonDefines() const;
    void lightDefines(Defines& defines, LightType type) const;
    /// Of passes over the screen, for one model.
    Defines screenDefines(const std::string& model) const;
    int bodyCount(LightType type) const;
    /// Whether lights with a body show on surfaces of this model.
    bool showsBodies(const std::string& model) const;
    PlannedArea areaMethod(const std::string& model) const;
    void planBodyLights();
    void planLightImages();
    Defines bodyDefines(const std::string& model, LightType type) const;
    Defines forwardBodyDefines(const std::string& model) const;
    void planBodyPasses();
    /// Whether the environment shows on surfaces of this model.
    bool showsEnvironment(const std::string& model) const;
    PlannedEnvironment environmentMethod(const std::string& model) const;
    void planEnvironmentShadow();
    void planEnvironment();
    Defines environmentDefines(const std::string& model) const;
    void planEnvironmentPass();
    bool isPrefiltered(const std::string& model) const;
    std::string whyNoShadowOfEnvironment() const;
    std::string whyNoOcclusion() const;
    void leaveOutOcclusionTextures();
    void planOcclusion();
    void planOcclusionChannels();
    void planOcclusionPass();
    void planBackground();
    void planBodyPass(LightType type);
    void shadowDefines(Defines& defines, LightType type) const;
    Defines surfaceDefines(const SurfaceFeatures& features) const;
    void planPasses();
    void planGbufferPass();
    void planCoverage();
    /// Without variants.
    PlannedPass lightPass(const std::string& name, const std::string& kind, const std::string& reason) const;
    void planLightPass(LightType type, int count);
    void fogDefines(Defines& defines) const;
    void airlightDefines(Defines& defines, LightType type) const;
    void requireAirlightLoop(const char* type, int count) const;
    void addFogVariants(PlannedPass& pass, const Defines& defines) const;
    void addFogDims(PlannedPass& pass) const;
    void planFog();
    void planAirlight();
    void peelDefines(Defines& defines) const;
    void forwardDefines(Defines& defines, const SurfaceFeatures& features) const;
    std::vector<std::string> forwardTargets() const;
    void planForward();
    void planDim();
    void planPeel(bool peeled);
    std::string radianceFormat() const { return plan_.quality.radianceBits == 16 ? "RGBA16F" : "RGBA32F"; }
    void planAccumulation();
    void planDataAovs();
    void planVertexData();
    const SceneSummary& scene_;
    const Capabilities& capabilities_;
    const AovSet& aovs_;
    FramePlan plan_;
    bool deferred_ = true, anyLight_ = false, unlit_ = false, hasDeferredSurface_ = false,
         needsDeferredTargets_ = false;
    bool dataAovs_ = false, contributions_ = false, gbufferRadiance_ = false, table_ = false;
    int normalBits_ = 16;  ///< of the target, where there is one
};

}  // namespace lobe
