#include <jet/testing/test_editor.hpp>

namespace jet::test {

TestEditor::TestEditor(EventsCenter& events, Catalog& catalog)
    : events_(events), catalog_(catalog), project_(Project::create("Test", events, catalog)),
      tree_(std::make_unique<ProjectTree>(*project_, events)), simulation_(events), plugins_(catalog)
{
}

TestEditor::~TestEditor() = default;

void TestEditor::openScene(Scene& scene)
{
    activeScene_ = &scene;
    events_.post(static_cast<Editor*>(this), ActiveSceneChanged{&scene});
}

Progress TestEditor::progress(const std::string&)
{
    return Progress{[this](double done) {
        progressed.push_back(done);
        return done < cancelAt;
    }};
}

void TestEditor::openScript(Scene&, ItemId script, int line) { openedScripts.emplace_back(script, line); }

void TestEditor::setActiveTool(std::string_view id)
{
    tool_ = id;
    events_.post(static_cast<Editor*>(this), ActiveToolChanged{tool_});
}

void TestEditor::setToolOption(std::string_view property, Value value) { toolOptions.set(property, std::move(value)); }

}  // namespace jet::test
