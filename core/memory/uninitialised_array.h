#pragma once
// Arrays whose memory is first touched by the thread that fills it, so that it is allocated near that thread.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace kaustik {

// Owns `size` values, which are uninitialised at first. Move-only.
template <class T>
class UninitialisedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  UninitialisedArray() = default;
  explicit UninitialisedArray(size_t size) : data_(std::make_unique_for_overwrite<T[]>(size)), size_(size) {}

  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  void clear() {
    data_.reset();
    size_ = 0;
  }
  // Hands the values over.
  std::unique_ptr<T[]> release() && {
    size_ = 0;
    return std::move(data_);
  }

 private:
  std::unique_ptr<T[]> data_;
  size_t size_ = 0;
};

// Allocator for vectors whose default-initialised values stay uninitialised.
template <class T>
struct UninitialisedAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UninitialisedAllocator<U>;
  };

  void construct(T*) noexcept {}
  template <class... Args>
  void construct(T* at, Args&&... args) {
    std::construct_at(at, std::forward<Args>(args)...);
  }
};

}  // namespace kaustik
