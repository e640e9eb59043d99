// A Cornell box of 2 m with a sphere of glass and one of mirror, for POV-Ray 3.7 with photons and radiosity. Ours; the
// same content as a pbrt scene of that name: a lamp of 0.5 x 0.5 m and radiance (17, 12, 4) at 1.98 m.
//
//   povray cornell-glass-mirror.pov +W512 +H512 +FE +Oout.exr -D +WT2 Declare=Photons=100000 Declare=Count=200 ...
//
// POV-Ray's colours have no unit: a white surface of diffuse 1 under a light of colour 1 shows 1. Here they are
// radiances. Its lights have neither inverse squares nor the lamp's cosine by themselves:
// fade_power 2 from a very small fade_distance d gives 2 d^2 / r^2, a spot of half angle 90 degrees and tightness 1 the
// cosine, so that L A / (2 pi d^2) lights like a lamp of radiance L and area A.
#version 3.7;
#ifndef (Photons) #declare Photons = 100000; #end
#ifndef (Count) #declare Count = 200; #end
#ifndef (ErrorBound) #declare ErrorBound = 0.5; #end
#ifndef (Depth) #declare Depth = 4; #end
#ifndef (LampGrid) #declare LampGrid = 8; #end

global_settings {
  assumed_gamma 1
  max_trace_level 32
  adc_bailout 1 / 1024
  photons { count Photons autostop 0 max_trace_level 16 }
  radiosity {
    pretrace_start 0.08 pretrace_end 0.01
    count Count nearest_count 10 error_bound ErrorBound low_error_factor 0.6
    recursion_limit Depth brightness 1 gray_threshold 0 minimum_reuse 0.01
  }
}

// Field of view 19.5 degrees, x to the right.
camera {
  location <0, 1, 6.8>
  direction -z * 0.5 / tan(radians(19.5 / 2))
  up y
  right x
}

#declare Wall = finish { ambient 0 diffuse 1 specular 0 }
#declare White = texture { pigment { rgb <0.725, 0.71, 0.68> } finish { Wall } }
#declare Green = texture { pigment { rgb <0.14, 0.45, 0.091> } finish { Wall } }
#declare Red = texture { pigment { rgb <0.63, 0.065, 0.05> } finish { Wall } }

polygon { 5, <-1, 0, -1>, <1, 0, -1>, <1, 0, 1>, <-1, 0, 1>, <-1, 0, -1> texture { White } }
polygon { 5, <-1, 2, -1>, <1, 2, -1>, <1, 2, 1>, <-1, 2, 1>, <-1, 2, -1> texture { White } }
polygon { 5, <-1, 0, -1>, <1, 0, -1>, <1, 2, -1>, <-1, 2, -1>, <-1, 0, -1> texture { White } }
polygon { 5, <1, 0, -1>, <1, 0, 1>, <1, 2, 1>, <1, 2, -1>, <1, 0, -1> texture { Green } }
polygon { 5, <-1, 0, -1>, <-1, 0, 1>, <-1, 2, 1>, <-1, 2, -1>, <-1, 0, -1> texture { Red } }

// Left out of radiosity: its light comes from the light source.
#declare Radiance = <17, 12, 4>;
#declare Side = 0.5;
#declare FadeDistance = 0.001;
#declare LampBody = polygon {
  5, <-0.25, 1.98, -0.25>, <0.25, 1.98, -0.25>, <0.25, 1.98, 0.25>, <-0.25, 1.98, 0.25>, <-0.25, 1.98, -0.25>
  texture { pigment { rgb Radiance } finish { ambient 0 diffuse 0 emission 1 } }
  no_shadow
  no_radiosity
}
object { LampBody }
light_source {
  <0, 1.979, 0>
  rgb Radiance * Side * Side / (2 * pi * FadeDistance * FadeDistance)
  spotlight point_at <0, 0, 0> radius 89.99 falloff 90 tightness 1
  area_light Side * x, Side * z, LampGrid, LampGrid jitter area_illumination on
  fade_distance FadeDistance
  fade_power 2
  photons { reflection on refraction on area_light }
}

sphere {
  <0.45, 0.36, 0.35>, 0.35
  pigment { rgbf 1 }
  finish { ambient 0 diffuse 0 specular 0 reflection { 0, 1 fresnel on } conserve_energy }
  interior { ior 1.5 }
  photons { target reflection on refraction on collect off }
}
sphere {
  <-0.45, 0.41, -0.3>, 0.4
  pigment { rgb 0 }
  finish { ambient 0 diffuse 0 specular 0 reflection { 0.9 } }
  photons { target reflection on refraction off collect off }
}
