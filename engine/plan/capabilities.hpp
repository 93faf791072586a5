/// What the plan must know of an OpenGL context, without OpenGL.
#pragma once

namespace lobe {

struct Capabilities {
    bool clipControl = false;  ///< ARB_clip_control: depth from 0 to 1, reversed
    bool anisotropicFilter = false;
    bool softwareRasteriser =
        false;                    ///< llvmpipe, softpipe: sRGB decode and 8-bit filtering are inexact there
    bool reliableTimers = false;  ///< timer queries measure passes (hardware drivers)
    int maxTextureSize = 1024;    ///< GL 3.3's guaranteed minimum
    int maxColorAttachments = 8;
    int maxArrayLayers = 256;  ///< of a texture array
    int maxTextureBufferTexels = 65536;
};

}  // namespace lobe
