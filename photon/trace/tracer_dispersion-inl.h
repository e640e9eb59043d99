#pragma once
// Photons at glass that disperses. Included by tracer-inl.h only.

namespace kaustik::photon::detail {

// The parts have equal flux, and there is one for each of the photon's wavelengths: a few photons then show
// the whole spectrum, where one would be a speck of one colour. Parts that smooth glass reflects stay white
// and go on together. The others are queued. What they carry is taken from the energy that arrived, so that
// the ledger balances.
template <class Accel, class Sink>
bool Tracer<Accel, Sink>::divide(size_t k, const SurfaceInteraction& si, const Arrival& photon) {
  const WalkState before = walkers_.state[k];
  const Arrival part{photon.ray, photon.flux / float(WalkState::kParts)};
  int32_t scattered = 0, queued = 0, kept = 0;
  WalkState white;
  Ray on;
  Rgb reflected(0);
  for (uint32_t i = 0; i < WalkState::kParts; ++i) {
    walkers_.state[k] = before.of_part(i);
    lanes_.scattered_energy[k] = lanes_.next_energy[k] = 0;
    SurfaceInteraction here = si;
    const BsdfAt bsdf_at(scene_, here, -photon.ray.d, {}, wavelength_of(k));
    const bool goes_on = scatter(k, std::get<Dielectric>(*bsdf_at), here, part);
    scattered += lanes_.scattered_energy[k];
    if (!goes_on) continue;
    if (walkers_.state[k].is_dispersed()) {
      queued += queue_next(k);
    } else {
      white = walkers_.state[k], on = lanes_.next.get(k);
      reflected += get_lane(lanes_.next_flux, k), kept += lanes_.next_energy[k];
    }
  }
  walkers_.energy[k] -= queued;
  walkers_.state[k] = white;
  lanes_.scattered_energy[k] = scattered - queued;
  lanes_.next_energy[k] = kept;
  lanes_.set_next(k, on, reflected);
  return !is_black(reflected);
}

template <class Accel, class Sink>
int32_t Tracer<Accel, Sink>::queue_next(size_t k) {
  const Ray on = lanes_.next.get(k);
  const int32_t energy = lanes_.next_energy[k];
  queue_of(on.d).push(on.o, on.d, get_lane(lanes_.next_flux, k), walkers_.reversed_index[k],
                      walkers_.state[k], energy);
  return energy;
}

}  // namespace kaustik::photon::detail
