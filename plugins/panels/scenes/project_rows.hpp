// ProjectRows: the project as rows of a tree: filters, scenes with their scripts, and files. Rows are made anew when
// the project changes and keep what is open and current by what they stand for.
#pragma once

#include <jet/editor.hpp>

#include <QTreeWidget>

#include <set>

namespace jet::scenes {

/// What a row stands for. Pointers are to what the project owns.
struct Row {
    enum class Kind { Scenes, Filter, Scene, Script, Files, File };
    Kind kind = Kind::Scenes;
    Filter* filter = nullptr;  ///< of Scenes the root; of Scene and Filter rows: the one itself, or the one it is in
    Scene* scene = nullptr;    ///< of Scene and Script rows
    ItemId script = {};
    std::string file = {};

    /// Equal for rows that stand for the same, over changes of the project.
    QString key() const;
};

class ProjectRows final : public QTreeWidget {
    Q_OBJECT

public:
    ProjectRows(Editor& editor, QWidget* parent);

    void rebuild();
    /// The current row; none where there is none.
    std::optional<Row> current() const;
    Row rowOf(const QTreeWidgetItem& item) const;
    /// The row that stands for the same is current, if it is there.
    void makeCurrent(const Row& row);
    void editCurrent();
    /// Is a name being typed?
    bool isEditing() const { return state() == EditingState; }

signals:
    void renamed(const jet::scenes::Row& row, const QString& name);
    /// Dropped before `index` of its kind among what is in `filter`, counted with the dragged row.
    void moved(const jet::scenes::Row& row, jet::Filter* filter, int index);
    void filesDropped(const QStringList& files);

protected:
    QStringList mimeTypes() const override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragMoveEvent(QDragMoveEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void addFilter(QTreeWidgetItem& parent, Filter& filter);
    void addScene(QTreeWidgetItem& parent, Filter& filter, Scene& scene);
    void addFiles(QTreeWidgetItem& parent);
    QTreeWidgetItem* add(QTreeWidgetItem* parent, Row row, const QString& text, const char* icon);
    QTreeWidgetItem* find(const QString& key) const;

    Editor& editor_;
    std::vector<Row> rows_;     // by the number in an item's data
    std::set<QString> closed_;  // keys; what is new is open
    bool building_ = false;
};

}  // namespace jet::scenes
