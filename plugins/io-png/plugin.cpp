// PNG pictures of scenes.
#include "png_exporter.hpp"

#include <jet/plugin.hpp>

JET_PLUGIN(plugin) { plugin.exporter<jet::png::PngExporter>("png"); }
