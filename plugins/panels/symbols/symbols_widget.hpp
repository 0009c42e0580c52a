// SymbolsWidget: the list of a scene's symbols with pictures and uses. A double click or Enter places one; F2 renames,
// Delete deletes one that is not used. Each change is one undo step of the scene.
#pragma once

#include <jet/editor.hpp>

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
    bool eventFilter(QObject* watched, QEvent* event) override;
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

    void addButtons(QWidget& bar);
    void openMenu(const QPoint& at);
    void run(const Command& command);
    void watch(Scene* scene);
    /// Is something of a symbol among what changed?
    bool concerns(const ItemsChanged::Burst& burst) const;
    void rebuild();
    /// Is a name being typed?
    bool isTyping() const;
    void showSymbol(QListWidgetItem& row, const Item& symbol);
    const Item* current() const;

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
    bool building_ = false;
    Subscription front_, changed_;
};

}  // namespace jet::symbol_list
