/// Settings of the library for this process.
#pragma once

namespace lobe::codec {

/// To be called before anything else of OpenImageIO; calls after the first do nothing.
void setUpOpenImageIo();

}  // namespace lobe::codec
