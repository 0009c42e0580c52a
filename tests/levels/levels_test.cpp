// Levels drawn by others (shared data, where it is there) through the whole chain: import, bodies, project file, play.
//
// Who draws a level knows what is ground; here a rule guesses it: a shape that reaches over most of the drawing, or has
// only an outline, is fixed; a fixed outline around other shapes is a frame, so it becomes hollow. Everything else
// falls, together with a soft ball and a rigid box dropped from above.
#include "host/plugins/plugin_manager.hpp"

#include <jet/effect.hpp>
#include <jet/project.hpp>
#include <jet/simulation.hpp>

#include <gtest/gtest.h>
#include <test_paths.hpp>

#include <filesystem>

namespace {

namespace fs = std::filesystem;
using namespace jet;

const fs::path kDrawings = fs::path(JET_SOURCE_DIR) / ".." / "shared" / "data" / "svg" / "real";

std::vector<fs::path> levels()
{
    std::vector<fs::path> files;
    std::error_code absent;
    for (const auto& entry : fs::directory_iterator(kDrawings, absent))
        if (entry.path().filename().string().starts_with("lvl") && entry.path().extension() == ".svg")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class Levels : public testing::Test {
protected:
    void SetUp() override
    {
        if (levels().empty()) GTEST_SKIP() << "the drawings of levels are not on this machine (" << kDrawings << ")";
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        plugins_.scan();
    }

    static host::PluginOptions options()
    {
        host::PluginOptions options;
        options.builtIn = host::builtInPluginFolder();
        options.searchPath = {options.builtIn};
        return options;
    }

    void importInto(Scene& scene, const fs::path& file)
    {
        const std::string content = readFile(file).orThrow();
        std::vector<FormatNote> notes;
        auto edit = scene.items().begin("Import");
        ImportRequest request{file, std::as_bytes(std::span(content.data(), content.size())), edit, scene.root(), notes,
                              {}};
        plugins_.importer("svg")->read(request).orThrow();
        edit.commit();
    }

    static std::vector<const Item*> shapes(const Scene& scene)
    {
        std::vector<const Item*> found;
        scene.root().walk([&](const Item& item) {
            if (item.is<ShapeItem>()) found.push_back(&item);
        });
        return found;
    }

    /// Does the item lie around most of the other shapes, as a frame does?
    static bool surroundsOthers(const Item& item, const std::vector<const Item*>& all)
    {
        const auto inside = std::count_if(all.begin(), all.end(), [&](const Item* other) {
            return other != &item && item.path().contains(other->path().bounds().center(), FillRule::EvenOdd) &&
                   item.path().bounds().contains(other->path().bounds());
        });
        return 2 * inside > static_cast<std::ptrdiff_t>(all.size()) - 1;
    }

    void giveBodies(Scene& scene)
    {
        const auto all = shapes(scene);
        const Box drawing = scene.root().bounds();
        auto edit = scene.items().begin("Give bodies");
        for (const Item* item : all) {
            const Box box = item->path().bounds();
            const bool wide = box.width() > 0.6 * drawing.width();
            if (box.isEmpty()) continue;  // a straight line encloses nothing
            if (wide && surroundsOthers(*item, all)) makeHollow(edit, *item, 0.2 * drawing.width());
            edit.addEffect(*item, "in-path-rigid-body", {{"mass", 1.0}});
            if (!wide && item->effect("polygon-face")) continue;
            edit.set(*item, "fixed", true);
        }
        const double r = 0.02 * drawing.width();
        const Item& ball = edit.add<ShapeItem>(scene.root(), Path::ellipse(freeBox(all, drawing, r)));
        edit.addEffect(ball, "polygon-face", {{"color", Color{220, 30, 30, 255}}});
        edit.addEffect(ball, "in-path-body", {{"ks", 400.0}, {"kd", 0.5}});
        auto taken = all;
        taken.push_back(&ball);
        const Item& box = edit.add<ShapeItem>(scene.root(), Path::rectangle(freeBox(taken, drawing, r)));
        edit.addEffect(box, "polygon-face", {{"color", Color{30, 90, 220, 255}}});
        edit.addEffect(box, "in-path-rigid-body", {{"mass", 1.0}});
        const Box below(Vec2(drawing.min.x(), drawing.max.y() + 1), drawing.max + Vec2(0, 0.1 * drawing.height()));
        const Item& floor = edit.add<ShapeItem>(scene.root(), Path::rectangle(below));
        edit.addEffect(floor, "polygon-face", {{"color", Color{150, 150, 150, 255}}});
        edit.addEffect(floor, "in-path-rigid-body", {{"mass", 1.0}});
        edit.set(floor, "fixed", true);
        edit.commit();
    }

    static void makeHollow(Transaction& edit, const Item& item, double thickness)
    {
        Path frame = item.path();
        const Path outside = Path::rectangle(frame.bounds().inflated(thickness));
        frame.contours().push_back(outside.contours().front());
        edit.setPath(item, frame);
        for (std::size_t i = 0; i < item.effects().size(); ++i)
            if (item.effects()[i].type == "polygon-face") edit.setEffect(item, i, "fill-rule", "evenodd");
    }

    // The first place, from the top, where a box of half-size r touches no shape.
    static Box freeBox(const std::vector<const Item*>& all, const Box& drawing, double r)
    {
        for (double y = drawing.min.y() + 2 * r; y < drawing.max.y(); y += r)
            for (double x = drawing.center().x(); x < drawing.max.x(); x += r) {
                const Box box(Vec2(x - r, y - r), Vec2(x + r, y + r));
                const bool free = std::none_of(all.begin(), all.end(), [&](const Item* item) {
                    return item->path().contains(box.center(), FillRule::EvenOdd) ||
                           item->path().nearest(box.center()).distance < 1.6 * r;
                });
                if (free) return box;
            }
        return Box(drawing.min - Vec2(2 * r, 2 * r), drawing.min);
    }

    void picture(const Scene& scene, const PoseSource* poses, const std::string& name)
    {
        Exporter* exporter = plugins_.exporter("png");
        ASSERT_NE(exporter, nullptr);
        std::vector<FormatNote> notes;
        const Box box = scene.root().bounds();
        const double scale = 800 / box.width();
        const ExportRequest request{scene,
                                    poses,
                                    View{box.min, scale},
                                    800,
                                    static_cast<int>(box.height() * scale) + 1,
                                    Color{255, 255, 255, 255},
                                    name,
                                    notes,
                                    {}};
        const auto content = exporter->write(request);
        ASSERT_TRUE(content) << content.error().text();
        ASSERT_TRUE(writeFileAtomically(folder_ / name, std::span<const std::byte>(*content)));
    }

    fs::path folder_ = fs::path(JET_BINARY_DIR) / "levels";
    EventsCenter events_;
    host::PluginManager plugins_{options()};
};

TEST_F(Levels, BecomeProjectsWithBodiesAndPlay600StepsWithoutExploding)
{
    for (const fs::path& file : levels()) {
        SCOPED_TRACE(file.filename().string());
        const std::string name = file.stem().string();
        auto project = Project::create(name, events_, plugins_);
        importInto(*project->scenes().front(), file);
        ASSERT_FALSE(shapes(*project->scenes().front()).empty());
        giveBodies(*project->scenes().front());
        ASSERT_TRUE(project->saveAs(folder_ / name));
        auto reopened = Project::load(folder_ / name, events_, plugins_);
        ASSERT_TRUE(reopened) << reopened.error().text();
        EXPECT_EQ((*reopened)->hash(), project->hash());
        const Scene& scene = *(*reopened)->scenes().front();
        picture(scene, nullptr, name + "-before.png");

        auto simulation = Simulation::start(scene, {});
        ASSERT_TRUE(simulation) << simulation.error().text();
        for (const OutputLine& line : (*simulation)->output()) ADD_FAILURE() << line.text;
        const double gravity = scene.setting("gravity").as<Vec2>().norm();
        // Nothing gains more than its fall: v = g t, with a margin for being pushed out of an overlap in the drawing.
        const double drawing = scene.root().bounds().size().norm();
        for (int step = 1; step <= 600; ++step) {
            (*simulation)->step();
            const BodyStates bodies = (*simulation)->world().bodies();
            const double limit = gravity * (*simulation)->time() + 2 * drawing;
            for (std::size_t i = 0; i < bodies.velocity.size(); ++i) {
                ASSERT_TRUE(isFinite(bodies.position[i])) << "body " << i << " at step " << step;
                ASSERT_LT(bodies.velocity[i].norm(), limit) << "body " << i << " at step " << step;
            }
        }
        picture((*simulation)->scene(), simulation->get(), name + "-after.png");
    }
}

}  // namespace
