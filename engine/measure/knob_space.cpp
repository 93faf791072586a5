#include "measure/knob_space.hpp"

#include <algorithm>

namespace lobe::measure {

KnobSpace::KnobSpace(const SceneSummary& summary) : summary_(summary) {
    for (const Knob& knob : knobTable()) {
        const std::string reason = knob.withoutEffect(summary, Quality{});
        values_.push_back(knob.values);
        if (!reason.empty()) {
            withoutEffect_.emplace_back(knob.name, reason);
            values_.back() = {knob.get(Quality{})};
        }
        sizes_.push_back(static_cast<int>(values_.back().size()));
    }
}

Choice KnobSpace::choiceOf(const Quality& quality) const {
    Choice choice;
    for (size_t k = 0; k < values_.size(); ++k) {
        const auto at = std::find(values_[k].begin(), values_[k].end(), knobTable()[k].get(quality));
        choice.push_back(at == values_[k].end() ? 0 : static_cast<int>(at - values_[k].begin()));
    }
    return choice;
}

Quality KnobSpace::qualityOf(const Choice& choice) const {
    Quality quality;
    for (size_t k = 0; k < values_.size(); ++k)
        knobTable()[k].set(quality, values_[k][static_cast<size_t>(choice[k])]);
    return quality;
}

Choice KnobSpace::canonical(const Choice& choice) const {
    const Quality quality = qualityOf(choice);
    Choice result = choice;
    for (size_t k = 0; k < values_.size(); ++k)
        if (!knobTable()[k].withoutEffect(summary_, quality).empty()) result[k] = 0;
    return result;
}

std::string KnobSpace::label(const Choice& choice) const {
    std::string text;
    const Quality quality = qualityOf(choice);
    for (size_t k = 0; k < values_.size(); ++k) {
        const Knob& knob = knobTable()[k];
        if (sizes_[k] < 2 || !knob.withoutEffect(summary_, quality).empty()) continue;
        text += (text.empty() ? "" : ", ") + knob.name + " " + values_[k][static_cast<size_t>(choice[k])];
    }
    return text;
}

nlohmann::json KnobSpace::withoutEffectJson() const {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& [name, reason] : withoutEffect_)
        list.push_back({{"knob", name}, {"reason", reason}});
    return list;
}

}  // namespace lobe::measure
