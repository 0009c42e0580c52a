#include "svg_importer.hpp"

#include "document.hpp"
#include "drawing.hpp"
#include "report.hpp"
#include "source_text.hpp"

namespace jet::svg {

Result<void> SvgImporter::read(ImportRequest& request)
{
    const SourceText source(request.data, request.file.string());
    Report report(source, request.notes);
    const Document document(source, report);
    if (document.elements().empty()) {
        return Error("This is no SVG drawing: it has no <svg> element.",
                     source.locate(document.brokenAt().value_or(0)));
    }
    Drawing drawing(document, request, report);
    return drawing.draw();
}

}  // namespace jet::svg
