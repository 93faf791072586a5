#include "style.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace lobe::view {
namespace {

constexpr float kTextSize = 15.0F;

/// Debian's, and where others have it; $LOBE_VIEW_FONT before all.
std::string fontFile() {
    const char* asked = std::getenv("LOBE_VIEW_FONT");
    for (const char* place :
         {asked, "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
          "/usr/share/fonts/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"}) {
        std::error_code ignored;
        if (place != nullptr && std::filesystem::is_regular_file(place, ignored)) return place;
    }
    return {};
}

}  // namespace

void setStyle(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    // Latin, Greek, and the signs of units and arrows.
    static const ImWchar ranges[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x2010, 0x2044, 0x2070,
                                     0x209F, 0x2190, 0x2193, 0x2200, 0x22FF, 0};
    if (const std::string file = fontFile(); !file.empty()) {
        io.Fonts->AddFontFromFileTTF(file.c_str(), std::round(kTextSize * scale), nullptr, ranges);
    } else {
        ImFontConfig config;
        config.SizePixels = std::round(13.0F * scale);  // ImGui's own, whose size is 13
        io.Fonts->AddFontDefault(&config);
    }
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0.0F;
    style.FrameRounding = 2.0F;
    style.WindowBorderSize = 0.0F;
    style.ItemSpacing = {6.0F, 5.0F};
    style.Colors[ImGuiCol_WindowBg] = {0.10F, 0.10F, 0.11F, 1.0F};
    style.Colors[ImGuiCol_PopupBg] = {0.12F, 0.12F, 0.13F, 1.0F};
    style.Colors[ImGuiCol_TextDisabled] = {0.62F, 0.62F, 0.62F, 1.0F};
    style.Colors[ImGuiCol_FrameBg] = {0.20F, 0.22F, 0.26F, 1.0F};
    style.DisabledAlpha = 0.65F;
    style.ScaleAllSizes(scale);
}

ImU32 seriesColor(size_t index) {
    // Without black and the darkest blue, which do not stand out from a dark ground.
    constexpr std::array<ImU32, 7> kOkabeIto = {IM_COL32(230, 159, 0, 255),  IM_COL32(86, 180, 233, 255),
                                                IM_COL32(0, 190, 140, 255),  IM_COL32(240, 228, 66, 255),
                                                IM_COL32(225, 110, 30, 255), IM_COL32(214, 140, 180, 255),
                                                IM_COL32(150, 160, 230, 255)};
    return kOkabeIto[index % kOkabeIto.size()];
}

}  // namespace lobe::view
