// PngExporter: a scene, or a moment of a running game, as a PNG picture.
#pragma once

#include <jet/format.hpp>

namespace jet::png {

/// Equal scenes give equal bytes. Where request.background is none the picture is transparent.
class PngExporter final : public Exporter {
public:
    Result<std::vector<std::byte>> write(const ExportRequest& request) override;
};

}  // namespace jet::png
