#pragma once

#include "place/route/route.hpp"

#include <filesystem>

/// A route as a folder of pictures, CSV and NumPy arrays, for other programs.
///
///     route.csv                  name,value: format, unit, metric, latitude_deg, longitude_deg
///     settings.csv               traverse,name,value: 0 is the route itself
///     traverses.csv              traverse (from 1 on),name,source,frames,duration_s,...
///     descriptors.csv            descriptor (from 1 on),form,width,height: pixels, columns or floats
///     learned-D.npy              what descriptor D learned, bytes
///     traverse-T/keyframes.csv   frame,time_s,displacement,distance_m,x_m,y_m,heading_rad,after_gap,
///                                preview,points_bytes
///     traverse-T/descriptors-D.npy   a row for each keyframe: uint8 (pixels), int8 (columns), float32
///     traverse-T/thumbnails.npy  uint8, a row for each keyframe, where they are kept
///     traverse-T/places.csv      frame,distance_m,name, where places have names
///     traverse-T/preview-FRAME.jpg
///     traverse-T/points.npy      the keyframes' SURF points one after another, packed, where they are kept
///
/// Numbers are written such that they read back as the same; headings are in radians for that reason.
namespace place {

/// Writes it as a new folder, which appears whole or not at all. Throws `vo::Error` if there is something at
/// `folder` that is no empty folder, or if it cannot be written.
void write_route_folder(const std::filesystem::path& folder, const Route& route);

/// Reads it back, with what was changed in it: rows of keyframes, descriptors and pictures must still fit
/// each other. Throws `vo::Error` naming the file that is missing or does not fit, and what was expected.
Route read_route_folder(const std::filesystem::path& folder);

}  // namespace place
