// Names every public type of the SDK, so that debug information and tables of virtual functions tell of all of them,
// also of those that no exported function mentions. Written by scripts/check-abi --update.
#include <jet/arrange.hpp>
#include <jet/assets.hpp>
#include <jet/body_point.hpp>
#include <jet/box_tool.hpp>
#include <jet/call_watch.hpp>
#include <jet/catalog.hpp>
#include <jet/change.hpp>
#include <jet/editor.hpp>
#include <jet/effect.hpp>
#include <jet/events.hpp>
#include <jet/find.hpp>
#include <jet/format.hpp>
#include <jet/geometry.hpp>
#include <jet/input.hpp>
#include <jet/item.hpp>
#include <jet/item_type.hpp>
#include <jet/items_center.hpp>
#include <jet/journal.hpp>
#include <jet/line_tool.hpp>
#include <jet/live_body.hpp>
#include <jet/materials.hpp>
#include <jet/painter.hpp>
#include <jet/path.hpp>
#include <jet/path_operations.hpp>
#include <jet/physics.hpp>
#include <jet/physics_checks.hpp>
#include <jet/physics_removal.hpp>
#include <jet/physics_soft.hpp>
#include <jet/physics_view.hpp>
#include <jet/plugin.hpp>
#include <jet/plugins.hpp>
#include <jet/project.hpp>
#include <jet/project_lock.hpp>
#include <jet/project_tree.hpp>
#include <jet/property.hpp>
#include <jet/result.hpp>
#include <jet/rewind.hpp>
#include <jet/scene.hpp>
#include <jet/scene_painter.hpp>
#include <jet/script.hpp>
#include <jet/settings.hpp>
#include <jet/simulation.hpp>
#include <jet/tool.hpp>
#include <jet/tool_view.hpp>
#include <jet/ui/history_focus.hpp>
#include <jet/ui/number_expression.hpp>
#include <jet/ui/panel.hpp>
#include <jet/ui/pictures.hpp>
#include <jet/ui/qt_painter.hpp>
#include <jet/ui/scene_drop.hpp>
#include <jet/unmanaged_plugins.hpp>
#include <jet/value.hpp>

#include <type_traits>

// A delete through a pointer asks the compiler for the table of virtual functions.
template <class T>
void lookAt(T* object)
{
    if constexpr (std::is_polymorphic_v<T>) delete object;
}

#define TYPE(...)                                                                                                      \
    JET_API void abi_anchor(const __VA_ARGS__*) {}                                                                     \
    template void lookAt<__VA_ARGS__>(__VA_ARGS__*);

TYPE(jet::Alignment)
TYPE(jet::Distribution)
TYPE(jet::FlipAxis)
TYPE(jet::StackOrder)
TYPE(jet::AssetReference)
TYPE(jet::BodyPoint)
TYPE(jet::BoxTool)
TYPE(jet::CallWatch)
TYPE(jet::ContributionKind)
TYPE(jet::Contribution)
TYPE(jet::Catalog)
TYPE(jet::ItemAdded)
TYPE(jet::ItemRemoved)
TYPE(jet::ItemMoved)
TYPE(jet::PathChanged)
TYPE(jet::PropertyChanged)
TYPE(jet::TypeChanged)
TYPE(jet::EffectAdded)
TYPE(jet::EffectRemoved)
TYPE(jet::EffectMoved)
TYPE(jet::EffectPropertyChanged)
TYPE(jet::ScenePropertyChanged)
TYPE(jet::MaterialsChanged)
TYPE(jet::ProjectChanged)
TYPE(jet::ActiveSceneChanged)
TYPE(jet::ActiveToolChanged)
TYPE(jet::Editor)
TYPE(jet::Command)
TYPE(jet::PaintPurpose)
TYPE(jet::EffectState)
TYPE(jet::EffectInput)
TYPE(jet::Effect)
TYPE(jet::EventType)
TYPE(jet::Subscription)
TYPE(jet::EventsCenter)
TYPE(jet::FindQuery)
TYPE(jet::ShowArea)
TYPE(jet::Progress)
TYPE(jet::FormatNote)
TYPE(jet::ImportRequest)
TYPE(jet::Importer)
TYPE(jet::PoseSource)
TYPE(jet::View)
TYPE(jet::ExportRequest)
TYPE(jet::Exporter)
TYPE(jet::Affine)
TYPE(jet::Box)
TYPE(jet::Modifiers)
TYPE(jet::PointerButton)
TYPE(jet::PointerEvent)
TYPE(jet::WheelEvent)
TYPE(jet::KeyEvent)
TYPE(jet::GroupItem)
TYPE(jet::LayerItem)
TYPE(jet::ShapeItem)
TYPE(jet::BodyItem)
TYPE(jet::ScriptItem)
TYPE(jet::SpringItem)
TYPE(jet::RSpringItem)
TYPE(jet::SoundItem)
TYPE(jet::ImageItem)
TYPE(jet::TextItem)
TYPE(jet::TorqueItem)
TYPE(jet::EffectInstance)
TYPE(jet::Item)
TYPE(jet::WorldBuilder)
TYPE(jet::ItemType)
TYPE(jet::ItemsChanged)
TYPE(jet::SceneTouched)
TYPE(jet::HistoryChanged)
TYPE(jet::SelectionChanged)
TYPE(jet::Transaction)
TYPE(jet::ItemsCenter)
TYPE(jet::UndoRedoCenter)
TYPE(jet::ReplayedScene)
TYPE(jet::Journal)
TYPE(jet::JournalInfo)
TYPE(jet::Recovery)
TYPE(jet::LineTool)
TYPE(jet::LiveSpring)
TYPE(jet::LiveBody)
TYPE(jet::MaterialTable)
TYPE(jet::LineCap)
TYPE(jet::LineJoin)
TYPE(jet::Pen)
TYPE(jet::GradientStop)
TYPE(jet::LinearGradient)
TYPE(jet::RadialGradient)
TYPE(jet::GradientSpread)
TYPE(jet::Brush)
TYPE(jet::Image)
TYPE(jet::TextAlign)
TYPE(jet::TextStyle)
TYPE(jet::Painter)
TYPE(jet::FillRule)
TYPE(jet::Cubic)
TYPE(jet::Segment)
TYPE(jet::Contour)
TYPE(jet::PathPosition)
TYPE(jet::Polyline)
TYPE(jet::Path)
TYPE(jet::Crossing)
TYPE(jet::MaterialPair)
TYPE(jet::Precision)
TYPE(jet::Simd)
TYPE(jet::Method)
TYPE(jet::WorldSettings)
TYPE(jet::SpringDef)
TYPE(jet::AngularSpringDef)
TYPE(jet::BodyCommon)
TYPE(jet::ShapeDef)
TYPE(jet::SoftBodyDef)
TYPE(jet::RigidBodyDef)
TYPE(jet::Anchor)
TYPE(jet::SpringActuatorDef)
TYPE(jet::AngularSpringActuatorDef)
TYPE(jet::TorqueActuatorDef)
TYPE(jet::ForceActuatorDef)
TYPE(jet::JointDef)
TYPE(jet::JointState)
TYPE(jet::ContactEvent)
TYPE(jet::CastHit)
TYPE(jet::QueryFilter)
TYPE(jet::Contact)
TYPE(jet::BodyStates)
TYPE(jet::StepStats)
TYPE(jet::PhysicsWorld)
TYPE(jet::PhysicsEngine)
TYPE(jet::PhysicsChecks)
TYPE(jet::ActuatorKind)
TYPE(jet::WorldRemoval)
TYPE(jet::LiveAngularSprings)
TYPE(jet::SoftMatter)
TYPE(jet::ForceFieldDef)
TYPE(jet::PhysicsMarks)
TYPE(jet::PhysicsPicture)
TYPE(jet::PhysicsMarksChanged)
TYPE(jet::PluginRegistrar)
TYPE(JetPluginEntry)
TYPE(jet::PluginState)
TYPE(jet::CallbackCost)
TYPE(jet::PluginInfo)
TYPE(jet::PluginsChanged)
TYPE(jet::PluginChange)
TYPE(jet::Availability)
TYPE(jet::Provider)
TYPE(jet::PluginSetInfo)
TYPE(jet::PluginDifference)
TYPE(jet::PluginsCenter)
TYPE(jet::Filter)
TYPE(jet::PluginUse)
TYPE(jet::Overwrite)
TYPE(jet::Backup)
TYPE(jet::Project)
TYPE(jet::ProjectLock)
TYPE(jet::ProjectTreeChanged)
TYPE(jet::RemovedFiles)
TYPE(jet::ProjectTree)
TYPE(jet::PropertySpec)
TYPE(jet::PropertyTable)
TYPE(jet::Properties)
TYPE(jet::Location)
TYPE(jet::Error)
TYPE(jet::Failure)
TYPE(jet::RewindLimits)
TYPE(jet::RewindState)
TYPE(jet::RewindHistory)
TYPE(jet::Scene)
TYPE(jet::SceneBuilder)
TYPE(jet::SceneOverlay)
TYPE(jet::ScriptEventKind)
TYPE(jet::ScriptEvent)
TYPE(jet::ScriptRuntime)
TYPE(jet::ContactListening)
TYPE(jet::ScriptEngine)
TYPE(jet::SettingsChanged)
TYPE(jet::Settings)
TYPE(jet::SimulationOptions)
TYPE(jet::OutputLine)
TYPE(jet::GameView)
TYPE(jet::HeldBody)
TYPE(jet::Simulation)
TYPE(jet::SimulationFrame)
TYPE(jet::SimulationStateChanged)
TYPE(jet::SimulationFrameReady)
TYPE(jet::OutputPrinted)
TYPE(jet::SimulationCenter)
TYPE(jet::ToolHost)
TYPE(jet::Tool)
TYPE(jet::ToolView)
TYPE(jet::ui::HistoryFocus)
TYPE(jet::ui::HistoryFocusWatch)
TYPE(jet::ui::NumberContext)
TYPE(jet::Panel)
TYPE(jet::ui::PictureFit)
TYPE(jet::ui::QtPainter)
TYPE(jet::ui::DroppedOnScene)
TYPE(jet::UnmanagedPlugins)
TYPE(jet::ItemId)
TYPE(jet::Color)
TYPE(jet::RawText)
TYPE(jet::ValueKind)
TYPE(jet::Value)
