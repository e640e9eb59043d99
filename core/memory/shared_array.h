#pragma once
// Immutable arrays whose memory belongs to the program or to a file that is mapped into it.

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

#include "core/memory/uninitialised_array.h"

namespace kaustik {

// Copies share the values.
template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  // Takes the values over.
  explicit SharedArray(UninitialisedArray<T>&& values)
      : size_(values.size()), data_(std::move(values).release()) {}
  // Values that exist as long as `owner` does.
  SharedArray(std::span<const T> values, const std::shared_ptr<const void>& owner)
      : size_(values.size()), data_(owner, values.data()) {}

  const T* data() const { return data_.get(); }
  size_t size() const { return size_; }
  size_t bytes() const { return size_ * sizeof(T); }
  bool empty() const { return size_ == 0; }
  const T& operator[](size_t i) const { return data_.get()[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  std::span<const T> span() const { return {data(), size_}; }

 private:
  size_t size_ = 0;
  std::shared_ptr<const T[]> data_;
};

}  // namespace kaustik
