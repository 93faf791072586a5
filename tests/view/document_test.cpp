// Changes, undo and the camera of lobe-view, without a window.
#include <gmock/gmock.h>

#include "base/error.hpp"
#include "camera_controller.hpp"
#include "document.hpp"
#include "scene/camera.hpp"

namespace lobe::view {
namespace {

app::SettingSources withAssignment(const std::string& key, const nlohmann::json& value) {
    app::SettingSources sources;
    sources.assignments.push_back({app::Assignment::Kind::set, key, value});
    return sources;
}

TEST(Document, ChangesWinOverAllThatWasGivenAndCanBeTakenBack) {
    Document document(withAssignment("exposure", "!1.5"));
    EXPECT_EQ(document.settings()->get("exposure"), 1.5);
    document.change("exposure", -2.0);
    EXPECT_EQ(document.settings()->get("exposure"), -2.0);
    EXPECT_TRUE(document.isChanged("exposure"));
    document.revert("exposure");
    EXPECT_EQ(document.settings()->get("exposure"), 1.5);
}

TEST(Document, WhatIsRefusedChangesNothing) {
    Document document({});
    const auto before = document.settings();
    EXPECT_THROW(document.change("exposure", 1e9), UsageError);
    EXPECT_THROW(document.change("no_such", 1), UsageError);
    EXPECT_EQ(document.settings(), before);
    EXPECT_FALSE(document.canUndo());
}

TEST(Document, UndoAndRedoStepThroughSettingsAndEdits) {
    Document document({});
    document.change("exposure", 1.0);
    Edits edits;
    edits.materials[0] = std::make_shared<const Material>();
    document.edit(edits);
    document.change("tone_mapping", "agx");
    document.undo();
    EXPECT_EQ(document.settings()->get("tone_mapping"), "none");
    EXPECT_EQ(document.edits(), edits);
    document.undo();
    EXPECT_TRUE(document.edits().empty());
    document.undo();
    EXPECT_EQ(document.settings()->get("exposure"), 0.0);
    EXPECT_FALSE(document.canUndo());
    for (int i = 0; i < 3; ++i)
        document.redo();
    EXPECT_EQ(document.settings()->get("tone_mapping"), "agx");
    EXPECT_EQ(document.edits(), edits);
    EXPECT_FALSE(document.canRedo());
    document.undo();
    document.change("exposure", 3.0);
    EXPECT_FALSE(document.canRedo());
}

TEST(Document, OneDragIsOneStep) {
    Document document({});
    for (const double exposure : {0.1, 0.2, 0.3})
        document.change("exposure", exposure, "exposure");
    document.change("env_rotation", 10.0, "env_rotation");
    document.undo();
    EXPECT_EQ(document.settings()->get("exposure"), 0.3);
    document.undo();
    EXPECT_EQ(document.settings()->get("exposure"), 0.0);
}

TEST(Document, APoseTakesThePlaceOfEveryOtherWayToPlaceTheCamera) {
    Document document(withAssignment("camera_azimuth", 30.0));
    document.setPose(Pose{{1.0, 2.0, 3.0}, {0.5, 0.0, 0.0}, 40.0});
    const app::Settings& settings = *document.settings();
    EXPECT_TRUE(settings.get("camera_azimuth").is_null());
    EXPECT_EQ(settings.get("camera_position"), nlohmann::json({1.0, 2.0, 3.0}));
    EXPECT_EQ(settings.get("camera_focal_point"), nlohmann::json({0.5, 0.0, 0.0}));
    EXPECT_EQ(settings.get("camera_view_angle"), 40.0);
    document.setPose({});
    EXPECT_EQ(document.settings()->get("camera_azimuth"), 30.0);
}

TEST(Document, TheWindowGivesTheSizeUnlessItIsAskedFor) {
    Document free({});
    free.setWindowSize(640, 360);
    EXPECT_EQ(free.settings()->get("resolution"), nlohmann::json({640, 360}));
    free.change("resolution", {100, 50});
    EXPECT_EQ(free.settings()->get("resolution"), nlohmann::json({100, 50}));
    Document fixed(withAssignment("resolution", "320x200"));
    fixed.setWindowSize(640, 360);
    EXPECT_EQ(fixed.settings()->get("resolution"), nlohmann::json({320, 200}));
}

Bounds unitBounds() {
    Bounds bounds;
    bounds.add({-1, -1, -1});
    bounds.add({1, 1, 1});
    return bounds;
}

TEST(CameraController, TakesOverACameraWithoutAJump) {
    const Camera camera = framingCamera(unitBounds(), 1.5);
    CameraController controller;
    controller.adopt(camera, unitBounds());
    const Pose pose = controller.pose();
    const Camera again = lookAt(pose.position, pose.focal, pose.viewAngle * M_PI / 180.0);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            EXPECT_NEAR(again.worldFromCamera[c][r], camera.worldFromCamera[c][r], 1e-12);
}

TEST(CameraController, MovesTheSameWayHoweverOftenItIsAskedAndArrivesExactly) {
    const auto run = [](double step) {
        CameraController controller;
        controller.adopt(framingCamera(unitBounds(), 1.5), unitBounds());
        controller.orbit(100.0, 40.0, 400.0);
        controller.dolly(2.0);
        for (double t = 0.0; t < 0.1 - 1e-9; t += step)
            controller.advance(step);
        const glm::dvec3 halfway = controller.pose().position;
        while (controller.advance(step)) {
        }
        return std::pair(halfway, controller.pose().position);
    };
    const auto [slowWay, slowEnd] = run(0.05);
    const auto [fastWay, fastEnd] = run(0.001);
    EXPECT_LT(glm::length(slowWay - fastWay), 1e-9);
    EXPECT_EQ(slowEnd, fastEnd);
}

TEST(CameraController, DraggingMovesWhatIsAtThePivotWithTheMouse) {
    CameraController controller;
    controller.adopt(Pose{{0, 0, 5}, {0, 0, 0}, 45.0}, unitBounds());
    controller.pan(10.0, 0.0, 400.0);
    while (controller.advance(0.02)) {
    }
    const Pose pose = controller.pose();
    // The old pivot is now ten pixels right of the middle.
    const double metres = 10.0 * 2.0 * 5.0 * std::tan(22.5 * M_PI / 180.0) / 400.0;
    EXPECT_NEAR(pose.focal.x, -metres, 1e-12);
    EXPECT_NEAR(pose.position.x, -metres, 1e-12);
}

}  // namespace
}  // namespace lobe::view
