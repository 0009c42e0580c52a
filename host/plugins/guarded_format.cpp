// Importers, exporters and commands under guard.
#include "guarded_object.hpp"

namespace jet::host {

namespace {

/// The caller's progress as the plugin gets it: what goes wrong in it is not the plugin's fault, and a plugin that was
/// switched off meanwhile (by a thread of its own) is asked to stop.
Progress guardedProgress(const Plugin& plugin, const Progress& progress)
{
    return {[&plugin, &progress](double done) {
        CallBoard::here().showLife();
        try {
            return plugin.usable() && progress(done);
        } catch (...) {
            return false;
        }
    }};
}

class GuardedImporter final : public Importer, GuardedObject<Importer, Callback::ImporterDestroy> {
public:
    using GuardedObject::GuardedObject;
    using GuardedObject::renewInner;

    Result<void> read(ImportRequest& request) override
    {
        ImportRequest own{request.file,   request.data,  request.edit,
                          request.parent, request.notes, guardedProgress(plugin_, request.progress)};
        Result<void> result;
        const bool fine = tell(Callback::ImporterRead, [&](Importer& importer) {
            result = resultOf<Result<void>>([&] { return importer.read(own); });
        });
        return fine ? result : Result<void>(switchedOff().error());
    }
};

class GuardedExporter final : public Exporter, GuardedObject<Exporter, Callback::ExporterDestroy> {
public:
    using Bytes = Result<std::vector<std::byte>>;
    using GuardedObject::GuardedObject;
    using GuardedObject::renewInner;

    Bytes write(const ExportRequest& request) override
    {
        ExportRequest own = request;
        own.progress = guardedProgress(plugin_, request.progress);
        Bytes result{std::vector<std::byte>()};
        const bool fine = tell(Callback::ExporterWrite, [&](Exporter& exporter) {
            result = resultOf<Bytes>([&] { return exporter.write(own); });
        });
        return fine ? std::move(result) : Bytes(switchedOff().error());
    }
};

class GuardedCommand final : public Command, GuardedObject<Command, Callback::CommandDestroy> {
public:
    using GuardedObject::GuardedObject;
    using GuardedObject::renewInner;

    void run(Editor& editor) override
    {
        tell(Callback::CommandRun, [&](Command& command) { command.run(editor); });
    }
    bool isEnabled(Editor& editor) const override
    {
        return ask(
            Callback::CommandIsEnabled, [&](Command& command) { return command.isEnabled(editor); }, false);
    }
};

}  // namespace

std::shared_ptr<Importer> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Importer> importer)
{
    return std::make_shared<GuardedImporter>(guard, plugin, std::move(importer));
}
std::shared_ptr<Exporter> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Exporter> exporter)
{
    return std::make_shared<GuardedExporter>(guard, plugin, std::move(exporter));
}
std::shared_ptr<Command> guarded(Guard& guard, Plugin& plugin, std::shared_ptr<Command> command)
{
    return std::make_shared<GuardedCommand>(guard, plugin, std::move(command));
}
void renew(Importer& guarded, std::shared_ptr<Importer> importer)
{
    static_cast<GuardedImporter&>(guarded).renewInner(std::move(importer));
}
void renew(Exporter& guarded, std::shared_ptr<Exporter> exporter)
{
    static_cast<GuardedExporter&>(guarded).renewInner(std::move(exporter));
}
void renew(Command& guarded, std::shared_ptr<Command> command)
{
    static_cast<GuardedCommand&>(guarded).renewInner(std::move(command));
}

}  // namespace jet::host
