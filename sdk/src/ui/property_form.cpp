#include <jet/ui/property_editor.hpp>

#include <QCoreApplication>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>

namespace jet::ui {

struct PropertyForm::Private {
    struct Row {
        PropertySpec spec;
        PropertyEditor* editor;
    };
    std::vector<Row> rows;
    Handler handler;
};

namespace {

QLabel* labelOf(const PropertySpec& spec, QWidget* parent)
{
    auto* label = new QLabel(QCoreApplication::translate("Properties", spec.label.c_str()), parent);
    label->setToolTip(QCoreApplication::translate("Properties", spec.help.c_str()));
    return label;
}

QFormLayout* rowsLayout(QWidget* form)
{
    auto* layout = new QFormLayout(form);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setHorizontalSpacing(8);
    layout->setVerticalSpacing(4);
    layout->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    layout->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    return layout;
}

QHBoxLayout* lineLayout(QWidget* form)
{
    auto* layout = new QHBoxLayout(form);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(6);
    return layout;
}

}  // namespace

PropertyForm::PropertyForm(std::span<const PropertySpec> specs, Layout layout, QWidget* parent)
    : QWidget(parent), d_(std::make_unique<Private>())
{
    QFormLayout* rows = layout == Layout::Rows ? rowsLayout(this) : nullptr;
    QHBoxLayout* line = rows ? nullptr : lineLayout(this);
    d_->rows.reserve(specs.size());
    for (const PropertySpec& spec : specs) {
        PropertyEditor* editor = createPropertyEditor(spec, this);
        editor->setObjectName(QString::fromStdString(spec.id));
        editor->setToolTip(QCoreApplication::translate("Properties", spec.help.c_str()));
        editor->setHandler([d = d_.get(), index = d_->rows.size()](const Value& value, EditPhase phase) {
            const PropertySpec changed = d->rows[index].spec;  // the handler may destroy the form
            if (const Handler handler = d->handler) handler(changed, value, phase);
        });
        d_->rows.push_back({spec, editor});
        if (rows) {
            rows->addRow(labelOf(spec, this), editor);
        } else {
            line->addWidget(labelOf(spec, this));
            line->addWidget(editor);
        }
    }
    if (line) line->addStretch(1);
}

PropertyForm::~PropertyForm() = default;

void PropertyForm::setHandler(Handler handler) { d_->handler = std::move(handler); }

void PropertyForm::show(const Source& source)
{
    for (const Private::Row& row : d_->rows) row.editor->show(source(row.spec));
}

}  // namespace jet::ui
