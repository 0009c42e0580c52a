// SvgImporter: reads a drawing into a scene. What is broken or unknown is noted with its line; the rest is drawn.
#pragma once

#include <jet/format.hpp>

namespace jet::svg {

class SvgImporter final : public Importer {
public:
    Result<void> read(ImportRequest& request) override;
};

}  // namespace jet::svg
