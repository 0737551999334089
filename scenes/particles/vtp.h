// VTK XML PolyData (.vtp), which ParaView and all programs built on VTK read.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scenes/particles/particle_frame.h"
#include "scenes/particles/particle_table.h"

namespace scenes {

/// The particles as points with a vertex cell each. Point data: velocity, radius, mass, birth_time (Float64), id,
/// material (UInt32), color (sRGB, UInt8). Field data: TimeValue (s), frame, simulation_hash, material_names. The
/// arrays are appended raw, little-endian.
std::string encodeVtp(const ParticleFrame& frame);

/// A file of a series and the time that it shows, s.
struct TimedFile {
    std::string name;
    double time = 0.0;
};

/// A .vtp.series file, which ParaView opens as one data set with times.
std::string encodeVtpSeries(std::span<const TimedFile> files);

/// Whether a file begins as an XML file does.
bool isXml(std::string_view bytes);

/// Reads the points of a file and of their data velocity, radius, mass and material. The arrays may be appended (raw or
/// base64) or inline (ASCII or base64), of any number type and byte order, but not compressed.
/// @param fileName  for messages
/// @throws InputError that names the line where it can
ParticleTable readVtp(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
