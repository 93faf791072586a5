/// WebP by libwebp itself: OpenImageIO 2.4 multiplies alpha into colour whatever it is asked, and what that
/// loses can't be had back.
#pragma once

#include "codec/bytes.hpp"
#include "image/image.hpp"

namespace lobe::codec::webp {

/// RGB, or RGBA when the file has alpha; throws InputError for damaged, animated and oversized ones.
Bitmap decode(Bytes file);

}  // namespace lobe::codec::webp
