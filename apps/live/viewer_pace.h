#pragma once
// How often those who follow a render may look at it, so that the render has the processors for itself.

namespace kaustik::app {

// The most that a viewer takes of the time of all cores that the program may use.
inline constexpr double kViewerShare = 0.015;

// Seconds for which a viewer rests after work that took so much processor time: it then takes kViewerShare of
// the usable cores.
double rest_after(double processor_seconds);

}  // namespace kaustik::app
