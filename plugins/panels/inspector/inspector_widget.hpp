// InspectorWidget: forms made from the declared properties of the selected items and their effects; with nothing
// selected, the settings of the scene. Every change is a transaction; changes of one gesture merge into one undo step.
#pragma once

#include "section.hpp"
#include "subject.hpp"

#include <jet/editor.hpp>
#include <jet/ui/property_editor.hpp>

#include <QScrollArea>
#include <QTimer>

#include <functional>

namespace jet::inspector {

class InspectorWidget final : public QScrollArea {
public:
    explicit InspectorWidget(Editor& editor);

private:
    void watch(Scene* scene);
    void refreshSoon();
    void refresh();
    void rebuild();

    void addSceneSections();
    void addItemSection();
    void addGeometrySection();
    void addTypeSection();
    void addEffectSection(const SharedEffect& effect);
    void addEffectButtons(Section& section, const SharedEffect& effect);
    void addEffectButton();
    Section& addSection(const QString& title);
    /// A form whose values come from `source`; it is shown again at each refresh.
    ui::PropertyForm* addForm(Section& section, std::span<const PropertySpec> specs, ui::PropertyForm::Source source,
                              ui::PropertyForm::Handler handler);
    ui::PropertyForm* addForm(Section& section, const PropertyTable& table, ui::PropertyForm::Source source,
                              ui::PropertyForm::Handler handler)
    {
        return addForm(section, table.specs(), std::move(source), std::move(handler));
    }

    /// Runs `change` on each item in one transaction.
    void editItems(std::string_view label, const std::string& key, ui::EditPhase phase,
                   const std::function<void(Transaction&, const Item&)>& change);
    /// The same on their effect, given its index; items that have lost it meanwhile are left out.
    void editEffect(std::string_view label, const SharedEffect& effect, const std::string& key, ui::EditPhase phase,
                    const std::function<void(Transaction&, const Item&, std::size_t)>& change);
    void edit(std::string_view label, const std::string& key, ui::EditPhase phase,
              const std::function<void(Transaction&)>& change);
    void changeGeometry(const PropertySpec& spec, const Value& value, ui::EditPhase phase);
    void addEffect(const std::string& id);
    QString effectLabel(const std::string& id) const;

    Editor& editor_;
    Scene* scene_ = nullptr;
    Subject subject_;
    QWidget* body_ = nullptr;
    std::vector<std::pair<ui::PropertyForm*, ui::PropertyForm::Source>> forms_;
    QTimer soon_;
    int gesture_ = 0;  // part of the merge key: changes of different gestures stay apart
    Subscription front_, changed_, selected_, touched_;
};

}  // namespace jet::inspector
