/// The panels. Each is a function of the viewer, drawn within a tab.
#pragma once

namespace lobe::view {

struct Viewer;

void drawSettingsPanel(Viewer& viewer);
void drawMaterialsPanel(Viewer& viewer);
void drawLightsPanel(Viewer& viewer);
void drawComparePanel(Viewer& viewer);
void drawPlanPanel(Viewer& viewer);
void drawTimePanel(Viewer& viewer);
void drawPixelPanel(Viewer& viewer);
void drawLogPanel(Viewer& viewer);

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
