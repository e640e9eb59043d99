#pragma once
// Compares what shoots have stored.

#include <cstring>

#include "photon/record/photon_record.h"

namespace kaustik::test {

// Whether both hold the same bytes.
inline bool same_records(const photon::PhotonRecords& a, const photon::PhotonRecords& b) {
  // memcmp takes no null pointer, even for nothing.
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(photon::PhotonRecord)) == 0);
}

}  // namespace kaustik::test
