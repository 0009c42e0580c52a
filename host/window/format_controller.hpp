// FormatController: import and export of scenes through the format plugins.
#pragma once

#include "window/actions.hpp"
#include "window/documents.hpp"

#include <filesystem>

namespace jet::host {

class FormatController final : public QObject {
    Q_OBJECT

public:
    FormatController(Editor& editor, Documents& documents, QWidget* window);

    std::vector<ActionSpec> actions();
    /// Into the front scene, as one undo step; a picture becomes an image item in the middle of the view. False, and
    /// the scene unchanged, when the file cannot be read.
    bool importFile(const std::filesystem::path& file);
    bool exportFile(const std::filesystem::path& file);
    /// Files dropped on the window: packages of plugins (.jetplugin) are installed, pictures placed at that point of
    /// the scene, the others imported.
    void importFiles(const QStringList& files, const QPointF& at = {});
    /// Takes drops of packages anywhere on the window; views take drops of all files themselves.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// Is it a picture that no importer reads?
    bool isPicture(const std::filesystem::path& file) const;
    void installPackage(const std::filesystem::path& file);
    void askAndImport();
    void askAndExport();
    QString filters(ContributionKind kind, const QString& all) const;
    void report(const std::vector<FormatNote>& notes);

    Editor& editor_;
    Documents& documents_;
    QWidget* window_;
    QString lastFolder_;
};

}  // namespace jet::host
