#include "debug_marks.hpp"
#include "project_access.hpp"
#include "recorded_input.hpp"

#include "host/projects/setting_place.hpp"

#include <jet/format.hpp>
#include <jet/physics_view.hpp>
#include <jet/scene_painter.hpp>
#include <jet/simulation.hpp>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace jet::host {

namespace {

constexpr int kViewWidth = 1280, kViewHeight = 720;  // pixels, unless told otherwise
constexpr double kMaxSide = 16384;                   // pixels, as --width and --height take

/// A game as it is now, with marks of its physics.
class MarkedPlay final : public PoseSource, public SceneOverlay {
public:
    MarkedPlay(const Simulation& simulation, const PhysicsMarks& marks)
        : simulation_(simulation), marks_(marks), picture_(simulation.physicsPicture())
    {
    }
    const Path* pose(const Item& item) const override { return simulation_.pose(item); }
    const LiveBody* liveBody(const Item& item) const override { return simulation_.liveBody(item); }
    void paintOver(Painter& painter) const override { paintPhysics(picture_, marks_, painter); }

private:
    const Simulation& simulation_;
    PhysicsMarks marks_;
    PhysicsPicture picture_;
};

/// One headless run: steps the simulation, follows playScene(), keeps the hashes for --record.
class Player {
public:
    Player(Session& session, Project& project, const PlayOptions& options)
        : session_(session), project_(project), options_(options)
    {
    }

    Result<void> run(const Scene& scene)
    {
        if (!options_.input.empty()) {
            auto input = RecordedInput::read(options_.input);
            if (!input) return input.error();
            input_ = std::move(*input);
        }
        if (const auto possible = findExporter(); !possible) return possible;
        for (const std::filesystem::path& file : {options_.state, options_.record, options_.snapshot})
            if (const auto possible = mayWrite(file); !possible) return possible;
        if (const auto begun = begin(scene); !begun) return begun;
        const auto before = std::chrono::steady_clock::now();
        for (std::uint64_t step = 0; step < options_.steps; ++step) {
            input_.apply(*simulation_, step,
                         [this](const std::string& what, const Location& where) { session_.warning(what, where); });
            simulation_->step();
            if (auto problem = session_.problem()) return *problem;
            if (step % 60 == 59) hashes_.push_back({{"step", step + 1}, {"hash", hashText(simulation_->hash())}});
            if (!simulation_->requestedScene()) continue;
            const std::string wanted = *simulation_->requestedScene();
            const Scene* next = project_.scene(wanted);
            if (!next) return Error("a script went to the scene '" + wanted + "', which the project does not have");
            if (const auto begun = begin(*next); !begun) return begun;
        }
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
        return {};
    }

    Result<void> writeFiles()
    {
        if (!options_.state.empty())
            if (const auto written = writeFileAtomically(options_.state, simulation_->stateJson()); !written)
                return written;
        if (!options_.record.empty())
            if (const auto written = writeFileAtomically(options_.record, record()); !written) return written;
        return options_.snapshot.empty() ? Result<void>() : snapshot();
    }

    void report()
    {
        const double simulated = simulation_->time();
        if (session_.options().json) {
            std::printf("%s", simulation_->stateJson().c_str());
            return;
        }
        std::printf("played '%s': %llu steps, %.2f s simulated in %.3f s (%.0f × real time), hash %s\n",
                    simulation_->scene().name().c_str(), static_cast<unsigned long long>(simulation_->stepCount()),
                    simulated, seconds_, seconds_ > 0 ? simulated / seconds_ : 0,
                    hashText(simulation_->hash()).c_str());
    }

private:
    Result<void> begin(const Scene& scene)
    {
        SimulationOptions options;
        options.timeStep = options_.timeStep;
        options.physics = engineId(options_.physics);
        options.seed = options_.seed;
        options.threads = options_.threads;
        options.viewSize = viewSize();
        options.sceneByName = [this](std::string_view name) { return project_.scene(name); };
        auto started = Simulation::start(scene, options);
        if (!started) return placed(started.error(), scene);
        simulation_ = std::move(*started);
        if (auto problem = session_.problem()) return *problem;
        for (const OutputLine& line : simulation_->output()) print(line);
        simulation_->setOutputHandler([this](const OutputLine& line) { print(line); });
        return {};
    }

    /// What `jet plugins list` shows are ids of plugins: one stands for the engine the plugin has.
    std::string engineId(const std::string& given)
    {
        std::string id = given;
        for (const Contribution& one : session_.plugins().contributions(ContributionKind::PhysicsEngine)) {
            if (one.id == given) return given;
            if (one.plugin == given) id = one.id;
        }
        return id;
    }

    /// An engine that the scene names and nobody has is told with the line that names it.
    Error placed(Error error, const Scene& scene)
    {
        const auto wanted = scene.setting("physics").as<std::string>();
        if (!error.where.file.empty() || !options_.physics.empty() || wanted.empty()) return error;
        if (!session_.plugins().physicsEngine(wanted))
            error.where = placeOfSetting(project_.file(), scene.name(), "physics");
        return error;
    }

    // The game's own words go to stdout, troubles to stderr.
    void print(const OutputLine& line)
    {
        if (line.kind == OutputLine::Kind::Text) {
            if (!session_.options().json) std::printf("%s\n", line.text.c_str());
        } else {
            const Item* script = simulation_ ? simulation_->scene().items().find(line.script) : nullptr;
            Location where;
            if (script) where = {script->name(), line.line, 0};
            line.kind == OutputLine::Kind::Error ? session_.error(Error(line.text, where))
                                                 : session_.warning(line.text, where);
        }
    }

    // Asked before the run: who cannot get a file should not wait for it. What else may go wrong shows when it is
    // written.
    static Result<void> mayWrite(const std::filesystem::path& file)
    {
        const Location where{file.string(), 0, 0};
        std::error_code ignored;
        if (std::filesystem::is_directory(file, ignored)) return Error("is a folder; name a file to write", where);
        const std::filesystem::path folder = file.parent_path();
        if (folder.empty() || std::filesystem::is_directory(folder, ignored)) return {};
        return Error("cannot be written: there is no folder '" + folder.string() + "'; make it or choose another",
                     where);
    }

    Result<void> findExporter()
    {
        if (options_.snapshot.empty()) return {};
        const std::string extension = extensionOf(options_.snapshot);
        if (extension.empty())
            return Error("the name of a picture tells its format; give it an extension, as in picture.png",
                         Location{options_.snapshot.string(), 0, 0});
        exporter_ = session_.plugins().exporter(extension);
        if (exporter_) return {};
        return Error(session_.plugins().explain(ContributionKind::Exporter, extension),
                     Location{options_.snapshot.string(), 0, 0});
    }

    Vec2 viewSize() const
    {
        return {options_.width > 0 ? options_.width : kViewWidth, options_.height > 0 ? options_.height : kViewHeight};
    }

    /// The view, if it was asked for or the game moved its camera; else the page, as far as there is one.
    Vec2 pictureSize() const
    {
        const View& camera = simulation_->view().view;
        const Scene& scene = simulation_->scene();
        const Vec2 page(std::ceil(scene.setting("page-width").as<double>()),
                        std::ceil(scene.setting("page-height").as<double>()));
        const bool untouched = camera.anchor == Vec2(0, 0) && camera.scale == 1;
        const bool fits = page.minCoeff() > 0 && page.maxCoeff() <= kMaxSide;
        return options_.width == 0 && options_.height == 0 && untouched && fits ? page : simulation_->view().size;
    }

    Result<void> snapshot()
    {
        std::optional<MarkedPlay> marked;
        if (!options_.debug.empty()) marked.emplace(*simulation_, *debugMarks(options_.debug));
        const PoseSource& poses = marked ? static_cast<const PoseSource&>(*marked) : *simulation_;
        const Vec2 size = pictureSize();
        std::vector<FormatNote> notes;
        const Color background = simulation_->scene().setting("background").as<Color>();
        ExportRequest request{simulation_->scene(),
                              &poses,
                              simulation_->view().view,
                              static_cast<int>(size.x()),
                              static_cast<int>(size.y()),
                              background,
                              options_.snapshot,
                              notes,
                              {}};
        auto content = exporter_->write(request);
        if (!content) return content.error();
        return writeFileAtomically(options_.snapshot, std::span<const std::byte>(*content));
    }

    std::string record() const
    {
        using Json = nlohmann::ordered_json;
        Json events = Json::array();
        for (const RecordedEvent& event : input_.events()) events.push_back(Json::parse(RecordedInput::text(event)));
        return Json{{"steps", simulation_->stepCount()},
                    {"timeStep", simulation_->timeStep()},
                    {"seed", options_.seed},
                    {"events", events},
                    {"hashes", hashes_},
                    {"hash", hashText(simulation_->hash())}}
                   .dump(1) +
               "\n";
    }

    Session& session_;
    Project& project_;
    const PlayOptions& options_;
    RecordedInput input_;
    std::unique_ptr<Simulation> simulation_;
    Exporter* exporter_ = nullptr;
    nlohmann::ordered_json hashes_ = nlohmann::ordered_json::array();
    double seconds_ = 0;
};

}  // namespace

int play(Session& session, const PlayOptions& options)
{
    const auto project = openProject(session, options.project);
    if (!project) return kFailed;
    Player player(session, *project, options);
    if (const auto played = player.run(chooseScene(*project, options.scene)); !played) {
        session.error(played.error());
        return kFailed;
    }
    player.report();
    if (const auto written = player.writeFiles(); !written) {
        session.error(written.error());
        return kFailed;
    }
    return kOk;
}

}  // namespace jet::host
