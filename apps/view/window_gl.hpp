/// The few OpenGL functions that the window itself calls, of its own context: the engine's table belongs to
/// the drawing thread's.
#pragma once

#include <glad/gl.h>

namespace lobe::view {

struct WindowGl {
    PFNGLGENTEXTURESPROC genTextures;
    PFNGLDELETETEXTURESPROC deleteTextures;
    PFNGLBINDTEXTUREPROC bindTexture;
    PFNGLTEXPARAMETERIPROC texParameteri;
    PFNGLTEXIMAGE2DPROC texImage2D;
    PFNGLPIXELSTOREIPROC pixelStorei;
    PFNGLVIEWPORTPROC viewport;
    PFNGLCLEARCOLORPROC clearColor;
    PFNGLCLEARPROC clear;
    PFNGLREADBUFFERPROC readBuffer;
    PFNGLREADPIXELSPROC readPixels;
    PFNGLGETSTRINGPROC getString;
};

/// Of the window, whose context must be current when it is called first.
const WindowGl& windowGl();

}  // namespace lobe::view
