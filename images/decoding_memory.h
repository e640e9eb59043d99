#pragma once
// The memory of images that several threads decode at the same time.

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace kaustik::images {

// All members are thread-safe.
class DecodingMemory {
 public:
  // What one image takes, until the end of the object's life.
  class Part {
   public:
    // `left`: bytes that the process may still take. What a part has taken may be missing there already.
    Part(DecodingMemory& all, const std::function<uint64_t()>& left) : all_(all), left_(left) {}
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    ~Part() {
      {
        const std::lock_guard lock(all_.mutex_);
        all_.taken_ -= bytes_;
      }
      all_.given_back_.notify_all();
    }

    // Takes bytes, once, and waits for other parts to end where they do not fit beside them. False if they
    // do not fit even alone.
    bool take(uint64_t bytes) {
      std::unique_lock lock(all_.mutex_);
      bool fits = false;
      all_.given_back_.wait(lock, [&] {
        fits = bytes + all_.taken_ <= left_();
        return fits || all_.taken_ == 0;
      });
      if (!fits) return false;
      bytes_ = bytes;
      all_.taken_ += bytes;
      return true;
    }

   private:
    DecodingMemory& all_;
    const std::function<uint64_t()>& left_;
    uint64_t bytes_ = 0;
  };

 private:
  std::mutex mutex_;
  std::condition_variable given_back_;
  uint64_t taken_ = 0;
};

}  // namespace kaustik::images
