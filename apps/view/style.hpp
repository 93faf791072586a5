/// Looks: a dark theme with readable contrast, text as sharp as the display.
#pragma once

#include <imgui.h>

namespace lobe::view {

/// For the present ImGui context. `scale`: against 96 dots an inch.
void setStyle(float scale);

inline const ImVec4 kErrorColor{1.0F, 0.55F, 0.5F, 1.0F};
inline const ImVec4 kChangedColor{1.0F, 0.82F, 0.45F, 1.0F};
inline const ImVec4 kDimColor{0.68F, 0.68F, 0.68F, 1.0F};

/// Colours that all common kinds of colour vision tell apart (Okabe and Ito), for bars and curves.
ImU32 seriesColor(size_t index);

}  // namespace lobe::view
