#include "base/error.hpp"
#include "codec/codec.hpp"
#include "image/image_wire.hpp"

namespace lobe::codec {

Message serve(const Message& request) {
    namespace wire = image_wire;
    const wire::Request asked = wire::requestOf(request);
    switch (asked.task) {
        case wire::Task::decode:
            return wire::reply(decode(wire::fileOf(request)));
        case wire::Task::read:
            return wire::reply(read(wire::fileOf(request)));
        case wire::Task::readMetadata:
            return wire::reply(readMetadata(wire::fileOf(request)));
        case wire::Task::encodeBitmap:
            return wire::reply(encode(asked.extension, wire::bitmapOf(request), asked.options));
        case wire::Task::encodeImage:
            return wire::reply(encode(asked.extension, wire::imageOf(request), asked.options));
    }
    throw InputError("image worker: unexpected message: task " +
                     std::to_string(static_cast<int>(asked.task)));
}

}  // namespace lobe::codec
