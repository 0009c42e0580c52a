// SVG drawings as scenes. The way of a file: source_text -> document -> (css, style) -> drawing -> the transaction.
#include "svg_importer.hpp"

#include <jet/plugin.hpp>

JET_PLUGIN(plugin) { plugin.importer<jet::svg::SvgImporter>("svg"); }
