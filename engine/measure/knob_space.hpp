/// The knobs that matter to one scene, as a space to search.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/sweep.hpp"
#include "plan/knobs.hpp"

namespace lobe::measure {

class KnobSpace {
public:
    explicit KnobSpace(const SceneSummary& summary);

    /// How many values each knob has; 1 for those without effect.
    const std::vector<int>& sizes() const { return sizes_; }

    /// A value that is not among a knob's becomes its first.
    Choice choiceOf(const Quality& quality) const;
    Quality qualityOf(const Choice& choice) const;

    /// Knobs that have no effect with the others as they are, at their first values.
    Choice canonical(const Choice& choice) const;

    /// The knobs that matter: "ssaa4, texture_bits 8, shading deferred".
    std::string label(const Choice& choice) const;

    nlohmann::json withoutEffectJson() const;

private:
    SceneSummary summary_;
    std::vector<int> sizes_;
    std::vector<std::vector<std::string>> values_;
    std::vector<std::pair<std::string, std::string>> withoutEffect_;
};

}  // namespace lobe::measure
