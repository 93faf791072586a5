/// Memory that two processes share.
#pragma once

#include <cstddef>
#include <span>

namespace lobe {

/// Anonymous memory that can be handed to another process (memfd). Its size is sealed when it is made, so
/// that the other process can't shrink it under a reader, which would be a bus error there. Move-only;
/// unmapped on destruction.
class SharedMemory {
public:
    SharedMemory() = default;
    explicit SharedMemory(size_t bytes);            ///< zeroed and writable; throws std::bad_alloc
    static SharedMemory adopt(int fileDescriptor);  ///< maps what another process sent; takes the descriptor
    static SharedMemory copyOf(std::span<const std::byte> bytes);
    SharedMemory(SharedMemory&& other) noexcept;
    SharedMemory& operator=(SharedMemory&& other) noexcept;
    ~SharedMemory();

    std::span<std::byte> bytes() { return {data_, size_}; }
    std::span<const std::byte> bytes() const { return {data_, size_}; }
    size_t size() const { return size_; }
    int fileDescriptor() const { return descriptor_; }  ///< -1 when default-constructed or moved from

private:
    void map();
    std::byte* data_ = nullptr;
    size_t size_ = 0;
    int descriptor_ = -1;
};

}  // namespace lobe
