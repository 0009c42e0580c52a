// Framing: which part of a scene a picture shows, and how many pixels it has.
#pragma once

#include <jet/format.hpp>

namespace jet::png {

/// More pixels than these a picture does not get: beyond them memory and viewers give out.
inline constexpr int kMaxSide = 32768;
inline constexpr double kMaxPixels = 256.0 * 1024 * 1024;

struct Frame {
    int width = 0, height = 0;  ///< pixels
    Affine toPixels;            ///< scene units to pixels
    /// The scene area the picture shows.
    Box visible() const;
};

/// The frame of a request: its view, else the page (the scene settings page-width and page-height), else all that is
/// drawn. Fails, with the reason, for a size no picture can have.
Result<Frame> frameOf(const ExportRequest& request);

}  // namespace jet::png
