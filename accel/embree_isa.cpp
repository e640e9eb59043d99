#include "accel/embree_isa.h"

namespace kaustik::accel {

namespace {

std::string& limit() {
  static std::string isa;
  return isa;
}

}  // namespace

void limit_embree_isa(const std::string& isa) {
  limit() = isa;
}

const std::string& embree_isa_limit() {
  return limit();
}

}  // namespace kaustik::accel
