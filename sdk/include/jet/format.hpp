// Importers and exporters: file formats as plugins (SPEC EN11). `jet convert` and the window use the same objects.
#pragma once

#include <jet/catalog.hpp>
#include <jet/scene.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jet {

/// Long work reports here and asks whether to go on. [any thread]
struct Progress {
    /// Called with 0..1; returns false when the user cancelled. May be empty.
    std::function<bool(double)> report;
    bool operator()(double done) const { return !report || report(done); }
};

/// Something the reader or writer could not keep, with its place.
struct FormatNote {
    std::string message;
    Location where;
};

struct ImportRequest {
    std::filesystem::path file;       ///< for messages and for resolving relative references
    std::span<const std::byte> data;  ///< the whole file
    Transaction& edit;   ///< everything is created here: an import is one undo step, a failed one leaves nothing
    const Item& parent;  ///< the container that receives the items
    std::vector<FormatNote>& notes;  ///< what was left out or approximated
    Progress progress;
};

class JET_API Importer {
public:
    virtual ~Importer();
    /// Reads the file into the transaction. On an Error the caller rolls back. Never reads outside the file's own
    /// folder.
    virtual Result<void> read(ImportRequest& request) = 0;
};

struct LiveBody;

/// Gives each item its path while playing; see SceneView.
class JET_API PoseSource {
public:
    virtual ~PoseSource();
    /// The item's present path; null: the path it was drawn with.
    virtual const Path* pose(const Item& item) const = 0;
    /// Its soft body, where one of its effects wants it; else null.
    virtual const LiveBody* liveBody(const Item& item) const;
};

/// Which part of a scene is seen, and how large.
struct View {
    Vec2 anchor;       ///< scene point at the top-left corner
    double scale = 1;  ///< pixels a scene unit
    Affine toPixels() const { return Affine::scaling({scale, scale}) * Affine::translation(-anchor); }
};

struct ExportRequest {
    const Scene& scene;
    const PoseSource* poses = nullptr;  ///< for a snapshot of a running game
    std::optional<View> view;           ///< none: the whole scene, fitted
    int width = 0, height = 0;          ///< pixels; 0: from the other one or from the scene's bounds
    std::optional<Color> background;    ///< none: transparent where the format can
    std::filesystem::path file;         ///< the target's name, for messages; the caller writes it
    std::vector<FormatNote>& notes;
    Progress progress;
};

class JET_API Exporter {
public:
    virtual ~Exporter();
    /// The complete file content; the caller writes it atomically.
    virtual Result<std::vector<std::byte>> write(const ExportRequest& request) = 0;
};

// Files. Errors name the file, the reason and the remedy.
JET_API Result<std::string> readFile(const std::filesystem::path& file);
/// Writes beside the target, syncs, renames: the target is the old or the new content, never a part (SPEC IO1). A
/// symbolic link is followed; permissions are kept.
JET_API Result<void> writeFileAtomically(const std::filesystem::path& file, std::span<const std::byte> content);
JET_API Result<void> writeFileAtomically(const std::filesystem::path& file, std::string_view content);
/// Lower-case extension without dot.
JET_API std::string extensionOf(const std::filesystem::path& file);

}  // namespace jet
