#include "base/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "base/error.hpp"

namespace lobe {

SharedMemory::SharedMemory(size_t bytes) : size_(bytes) {
    if (bytes > static_cast<size_t>(std::numeric_limits<off_t>::max())) throw std::bad_alloc();
    descriptor_ = memfd_create("lobe", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (descriptor_ < 0) throw std::bad_alloc();
    if (ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0 ||
        fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0) {
        close(descriptor_);
        throw std::bad_alloc();
    }
    map();
}

SharedMemory SharedMemory::adopt(int fileDescriptor) {
    SharedMemory memory;
    memory.descriptor_ = fileDescriptor;
    struct stat status {};
    const int seals = fcntl(fileDescriptor, F_GET_SEALS);
    if (seals < 0 || (seals & F_SEAL_SHRINK) == 0 || fstat(fileDescriptor, &status) != 0 ||
        status.st_size < 0)
        throw InputError("shared memory: the descriptor is not memory of a sealed size");
    memory.size_ = static_cast<size_t>(status.st_size);
    memory.map();
    return memory;
}

SharedMemory SharedMemory::copyOf(std::span<const std::byte> bytes) {
    SharedMemory memory(bytes.size());
    if (!bytes.empty()) std::memcpy(memory.data_, bytes.data(), bytes.size());
    return memory;
}

void SharedMemory::map() {
    if (size_ == 0) return;  // mmap refuses an empty range
    void* address = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
    if (address == MAP_FAILED) {
        close(std::exchange(descriptor_, -1));
        size_ = 0;
        throw std::bad_alloc();
    }
    data_ = static_cast<std::byte*>(address);
}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

SharedMemory& SharedMemory::operator=(SharedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

SharedMemory::~SharedMemory() {
    if (data_ != nullptr) munmap(data_, size_);
    if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace lobe
