// What lies right of the wipe: another picture, the truth, the error against it.
#include <algorithm>
#include <cmath>

#include "viewer.hpp"

namespace lobe::view {

bool Viewer::withModel(const std::string& model) const {
    return ui.comparison.with == Comparison::With::model && ui.comparison.model == model;
}

void Viewer::requestOther() {
    const Comparison& comparison = ui.comparison;
    const bool drawnOne =
        comparison.with == Comparison::With::kept || comparison.with == Comparison::With::model;
    if (!drawnOne || !requested_ || requested_->moving) return;
    FrameRequest request = *requested_;
    attempt([&] {
        app::Settings settings =
            comparison.with == Comparison::With::kept ? *comparison.keptSettings : *document.settings();
        // Ours in all that is about where one looks from.
        for (const char* key : {"resolution", "camera", "camera_position", "camera_focal_point",
                                "camera_view_angle", "camera_azimuth", "camera_elevation"}) {
            settings.reset(key, "window");
            const nlohmann::json& value = document.settings()->get(key);
            if (!value.is_null()) settings.set(key, value, "window");
        }
        if (comparison.with == Comparison::With::model) settings.set("brdf", comparison.model, "window");
        request.settings = std::make_shared<const app::Settings>(std::move(settings));
        request.edits = comparison.with == Comparison::With::kept ? comparison.keptEdits : Edits{};
    });
    if (requestedOther_ && requestedOther_->base == request.base && requestedOther_->shown == request.shown &&
        requestedOther_->edits == request.edits &&
        requestedOther_->settings->toJson() == request.settings->toJson())
        return;
    request.number = ++number_;
    requestedOther_ = request;
    worker.drawOther(std::move(request));
}

void Viewer::compareWith(Comparison comparison) {
    const bool truthWas =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    comparison.wipe = ui.comparison.wipe;
    ui.comparison = std::move(comparison);
    const bool truthIs =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    worker.drawOther({});
    requestedOther_.reset();
    other.reset();
    otherPicture = {};
    otherLegend = {};
    errorSummary = {};
    truthRounds_ = 0;
    errorOf_ = 0;
    if (truthWas && !truthIs) truth.stop();
    if (truthIs) startTruth();
}

void Viewer::startTruth() {
    if (!document.scene()) return;
    const TruthSubject subject{document.scene(), document.settings(), document.edits()};
    if (truth.subject() == subject) return;
    truthRounds_ = 0;
    otherPicture = {};
    errorSummary = {};
    truth.start(subject);
}

void Viewer::updateTruth() {
    const bool wanted =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    if (!wanted || !document.scene()) return;
    // It is of what is shown; while that changes, there is none.
    const bool restless = camera.moving() || (lastMoved >= 0.0 && seconds() - lastMoved < kSettleSeconds);
    if (!restless) startTruth();
    const TruthState state = truth.state();
    if (!state.error.empty() && truthRounds_ >= 0) {
        say("no truth: " + state.error, true);
        truthRounds_ = -1;
    }
    if (!state.image || state.rounds <= truthRounds_) return;
    truthRounds_ = state.rounds;
    events.add("truth", {{"rounds", state.rounds}, {"relative_error", state.relativeError}});
    if (ui.comparison.with == Comparison::With::truth)
        attempt([&] { otherPicture.set(displayOf(*state.image, {}, *document.settings()).bitmap, true); });
    else
        updateErrorMap();
    settle_ = std::max(settle_, 2);
}

void Viewer::updateErrorMap() {
    if (ui.comparison.with != Comparison::With::error || !full) return;
    const TruthState state = truth.state();
    if (!state.image || truth.subject().settings != full->settings) return;
    const Image& test = full->image;
    const Image& right = *state.image;
    if (test.width != right.width || test.height != right.height) return;
    const size_t stride = right.channelCount(), mine = test.channelCount();
    double mean = 0.0;
    for (size_t i = 0; i < right.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            mean += static_cast<double>(right.values[i * stride + c]);
    mean /= 3.0 * static_cast<double>(right.pixelCount());
    Bitmap bitmap{test.width, test.height, 3, ComponentType::u8, {}};
    bitmap.data.resize(3 * test.pixelCount());
    ErrorSummary summary{true, 0.0, 0.0, 0.0};
    constexpr double kLow = 1e-3, kHigh = 1.0;
    for (size_t i = 0; i < test.pixelCount(); ++i) {
        double worst = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            const auto x = static_cast<double>(test.values[i * mine + c]);
            const auto t = static_cast<double>(right.values[i * stride + c]);
            const double share = std::abs(x - t) / (std::abs(t) + 0.5 * mean + 1e-30);
            worst = std::max(worst, share);
            summary.relMse += (x - t) * (x - t) / (t * t + 0.01);
        }
        summary.mean += worst;
        summary.largest = std::max(summary.largest, worst);
        const double at = std::log(std::max(worst, kLow) / kLow) / std::log(kHigh / kLow);
        const std::array<uint8_t, 3> color = falseColor(at);
        for (size_t c = 0; c < 3; ++c)
            bitmap.data[3 * i + c] = static_cast<std::byte>(color[c]);
    }
    summary.mean /= static_cast<double>(test.pixelCount());
    summary.relMse /= 3.0 * static_cast<double>(test.pixelCount());
    errorSummary = summary;
    otherLegend = {true, true, kLow, kHigh, "error / (truth + half its mean)"};
    otherPicture.set(bitmap, false);
    events.add("error", {{"relmse", summary.relMse}, {"mean", summary.mean}, {"largest", summary.largest}});
}

}  // namespace lobe::view
