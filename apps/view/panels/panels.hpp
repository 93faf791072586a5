/// The panels. Each is a function of the viewer, drawn within a tab.
#pragma once

namespace lobe::view {
struct Viewer;
}  // namespace lobe::view
namespace lobe {
struct Brdf;
struct Material;
}  // namespace lobe

namespace lobe::view {

void drawSettingsPanel(Viewer& viewer);
void drawMaterialsPanel(Viewer& viewer);
void drawLightsPanel(Viewer& viewer);
void drawComparePanel(Viewer& viewer);
void drawPlanPanel(Viewer& viewer);
void drawTimePanel(Viewer& viewer);
void drawPixelPanel(Viewer& viewer);
void drawLogPanel(Viewer& viewer);

/// f_r cos(theta_i) in the plane of incidence, for light at three angles.
void drawPolarPlot(Viewer& viewer, const Brdf& brdf, const Material& material);

void drawPanels(Viewer& viewer);  ///< the tabs with all of these
void drawStatusBar(Viewer& viewer);
void drawPictureArea(Viewer& viewer);  ///< the picture with what lies over it, and the mouse in it
void drawStartPage(Viewer& viewer, float x, float y, float width, float height);
void drawOpenDialog(Viewer& viewer);
void drawSaveDialog(Viewer& viewer);
void drawModelGrid(Viewer& viewer);
/// Handles of the chosen light over the picture. True while the mouse is theirs.
bool drawLightHandles(Viewer& viewer);

}  // namespace lobe::view
