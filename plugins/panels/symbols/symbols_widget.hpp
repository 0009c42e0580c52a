// SymbolsWidget: the list of a scene's symbols with pictures and uses. A double click or Enter places one; F2 renames,
// Delete deletes one that is not used. Each change is one undo step of the scene.
#pragma once

#include <jet/editor.hpp>
#include <jet/ui/command_bar.hpp>
#include <jet/ui/scene_drop.hpp>

#include <QListWidget>

#include <functional>
#include <span>

namespace jet::symbol_list {

class SymbolsWidget final : public QWidget {
    Q_OBJECT

public:
    explicit SymbolsWidget(Editor& editor);

    QListWidget& list() { return *list_; }

protected:
    void showEvent(QShowEvent* event) override;

private:
    struct Command {
        const char* icon;
        const char* text;
        void (SymbolsWidget::*run)();
        const char* key;  ///< while the list has the focus; empty: none
        bool needsSymbol, onBar;
    };
    static std::span<const Command> commands();

    ui::CommandBar* makeBar();
    void run(const Command& command);
    void watch(Scene* scene);
    /// Is something of a symbol among what changed?
    bool concerns(const ItemsChanged::Burst& burst) const;
    void rebuild();
    void showSymbol(QListWidgetItem& row, const Item& symbol);
    const Item* current() const;
    void takeDrop(const ui::DroppedOnScene& drop);

    void create();
    void place();
    void edit();
    void selectInstances();
    void detach();
    void rename();
    void giveName(const QListWidgetItem& row);
    void remove();

    Editor& editor_;
    Scene* scene_ = nullptr;
    QListWidget* list_;
    ui::CommandBar* bar_;
    bool building_ = false;
    Subscription front_, changed_, dropped_;
};

}  // namespace jet::symbol_list
