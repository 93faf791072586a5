/// From linear radiance to display codes (docs/tone.md): exposure, tone curve, sRGB encoding.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace lobe {

enum class ToneMapping : uint8_t { none, reinhard, aces, agx, neutral };

/// Names as on the command line, in the order of the enumeration.
const std::vector<std::string>& toneMappingNames();

/// Linear Rec.709 radiance (any finite, times 2^exposure already) to linear display RGB in 0..1. Negative is
/// taken as 0, and NaN comes out as 0. none: clamp. reinhard: luminance x/(1+x). aces: Hill's fit. agx: Troy
/// Sobotka's, polynomial of Wrensch. neutral: Khronos PBR Neutral.
void toneMap(ToneMapping curve, float rgb[3]);

/// sRGB encoding (IEC 61966-2-1) of a linear value in 0..1; decoding is its inverse.
float encodeSrgb(float linear);
float decodeSrgb(float encoded);

/// The 8-bit code whose exact sRGB value is nearest to encodeSrgb(linear) (exact rounding; clamps to 0..255,
/// NaN is 0).
uint8_t encodeSrgb8(float linear);

/// Channels R,G,B[,A] of `image` times 2^exposure, tone mapped and encoded to 8-bit RGB or RGBA (RGBA when
/// `keepAlpha`). Radiance is taken as premultiplied by coverage: with keepAlpha the colour is divided by A
/// first (PNG's alpha is unassociated); without it `background` is added times 1 - A. The background is a
/// linear display colour, neither exposed nor tone mapped: where nothing is in front of it, it comes out as
/// the colour that was asked for. Throws InputError when a channel is missing.
Bitmap toDisplay(const Image& image, float exposure, ToneMapping curve, bool keepAlpha,
                 const float background[3]);

}  // namespace lobe
