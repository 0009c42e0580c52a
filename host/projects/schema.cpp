#include "schema.hpp"

#include <libxml/parser.h>
#include <libxml/relaxng.h>

#include <memory>

namespace jet::host {

namespace {

template <auto free>
struct Free {
    template <class T>
    void operator()(T* what) const
    {
        free(what);
    }
};
using Schema = std::unique_ptr<xmlRelaxNG, Free<xmlRelaxNGFree>>;
using SchemaParser = std::unique_ptr<xmlRelaxNGParserCtxt, Free<xmlRelaxNGFreeParserCtxt>>;
using Validation = std::unique_ptr<xmlRelaxNGValidCtxt, Free<xmlRelaxNGFreeValidCtxt>>;
using Document = std::unique_ptr<xmlDoc, Free<xmlFreeDoc>>;

constexpr std::size_t kMost = 20;

struct Collector {
    std::string file;
    Findings found;
};

void collect(void* to, xmlErrorPtr error)
{
    auto& collector = *static_cast<Collector*>(to);
    if (collector.found.size() >= kMost) return;
    std::string text = error->message ? error->message : "is not as the schema says";
    while (text.ends_with('\n')) text.pop_back();
    collector.found.push_back(
        {Finding::Weight::Error, Location{collector.file, error->line, 0}, "by the schema: " + text, "", false});
}

void ignore(void*, xmlErrorPtr) {}

}  // namespace

Result<Findings> checkAgainstSchema(std::string_view text, const std::string& file, const std::filesystem::path& schema)
{
    if (text.find("<!DOCTYPE") != std::string_view::npos) return Findings{};  // nothing JET knows: no entities here
    const SchemaParser parser(xmlRelaxNGNewParserCtxt(schema.c_str()));
    if (parser) xmlRelaxNGSetParserStructuredErrors(parser.get(), ignore, nullptr);
    const Schema rules(parser ? xmlRelaxNGParse(parser.get()) : nullptr);
    if (!rules) return Error("this schema cannot be read; install JET again", Location{schema.string(), 0, 0});
    // No entities, no network; items may nest deeper than libxml2 likes.
    const Document document(xmlReadMemory(text.data(), static_cast<int>(text.size()), file.c_str(), "UTF-8",
                                          XML_PARSE_NONET | XML_PARSE_HUGE | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
    if (!document) return Findings{};  // the reader tells what is wrong
    const Validation validation(xmlRelaxNGNewValidCtxt(rules.get()));
    Collector collector{file, {}};
    xmlRelaxNGSetValidStructuredErrors(validation.get(), collect, &collector);
    const int outcome = xmlRelaxNGValidateDoc(validation.get(), document.get());
    if (outcome > 0 && collector.found.empty())
        collector.found.push_back(
            {Finding::Weight::Error, Location{file, 0, 0}, "is not as the schema says", "", false});
    return std::move(collector.found);
}

}  // namespace jet::host
