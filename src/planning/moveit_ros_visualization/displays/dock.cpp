#include "dock.hpp"

#include <ros/console.h>

#include <QGuiApplication>
#include <QInputDialog>
#include <QProgressBar>
#include <QProxyStyle>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QVBoxLayout>

#include "context_tab.hpp"
#include "joints_tab.hpp"
#include "manipulation_tab.hpp"
#include "objects_tab.hpp"
#include "planning_tab.hpp"
#include "stored_tabs.hpp"
#include "warehouse.hpp"

namespace moveit_rviz_plugin {
namespace {
// As large as its tab; where that is more than its share of the screen, the tab is scrolled, so that RViz's window, with its
// other panels, still fits.
constexpr double WIDTH_SHARE = 0.45, HEIGHT_SHARE = 0.33;
class Page : public QScrollArea {
 public:
  explicit Page(QWidget* tab) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setWidget(tab);
    viewport()->setAutoFillBackground(false);
    tab->setAutoFillBackground(false);
  }
  QSize sizeHint() const override { return widget()->sizeHint(); }
  QSize minimumSizeHint() const override {
    const QSize screen = QGuiApplication::primaryScreen()->availableSize();
    const QSize bars(verticalScrollBar()->sizeHint().width(), 0);
    return (widget()->minimumSizeHint() + bars)
        .boundedTo(QSize(static_cast<int>(WIDTH_SHARE * screen.width()), static_cast<int>(HEIGHT_SHARE * screen.height())));
  }
};

// Eight tabs are more than a narrow panel has room for: little beside their words.
class NarrowTabs : public QProxyStyle {
 public:
  int pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const override {
    return metric == PM_TabBarTabHSpace ? 10 : QProxyStyle::pixelMetric(metric, option, widget);
  }
};
}  // namespace

Dock::Dock(MotionPlanningDisplay* display, QWidget* parent) : QWidget(parent), display_(display) {
  setObjectName("MotionPlanningUI");
  tabs_ = new QTabWidget;
  tabs_->setObjectName("tabWidget");
  tabs_->setElideMode(Qt::ElideRight);  // all of them are to be seen before any is scrolled away
  auto* narrow = new NarrowTabs;
  narrow->setParent(this);
  tabs_->tabBar()->setStyle(narrow);
  const auto add = [this](auto* tab, const QString& title) {
    all_.push_back(tab);
    tabs_->setTabToolTip(tabs_->addTab(new Page(tab), title), title);
    return tab;
  };
  status_ = new StatusTab(this);
  context_ = add(new ContextTab(this), "Context");
  planning_ = add(new PlanningTab(this), "Planning");
  add(new JointsTab(this), "Joints");
  objects_ = add(new ObjectsTab(this), "Scene Objects");
  add(new StoredScenesTab(this), "Stored Scenes");
  add(new StoredStatesTab(this), "Stored States");
  add(status_, "Status");
  manipulation_ = add(new ManipulationTab(this), "Manipulation");
  tabs_->setCurrentIndex(1);
  progress_ = new QProgressBar;
  progress_->setObjectName("background_job_progress");
  progress_->setToolTip("Something is being done in the background");
  progress_->setRange(0, 0);
  progress_->setTextVisible(false);
  progress_->setMaximumHeight(6);
  progress_->hide();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->addWidget(tabs_, 1);
  layout->addWidget(progress_);
}

Dock::~Dock() = default;

void Dock::say(const std::string& line, bool error) {
  if (error) ROS_WARN_NAMED("moveit_rviz_plugin", "%s", line.c_str());
  later([this, line, error]() { status_->add(QString::fromStdString(line), error); });
}

void Dock::inBackground(std::function<void()> job) {
  display_->jobs().add([this, job]() {
    try {
      job();
    } catch (const std::exception& error) {
      say(error.what(), true);
    }
  });
}

Warehouse& Dock::warehouse() {
  const std::string file = Warehouse::fileFor(host_);
  if (!warehouse_ || warehouse_->file() != file) warehouse_ = std::make_unique<Warehouse>(file);
  return *warehouse_;
}

void Dock::useWarehouse(const std::string& host) {
  host_ = host;
  warehouse_.reset();
}

// Not modal: RViz goes on drawing.
void Dock::ask(const QString& title, const QString& label, const QString& preset,
               std::function<void(const QString&)> answered) {
  auto* dialog = new QInputDialog(this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(title);
  dialog->setLabelText(label);
  dialog->setTextValue(preset);
  connect(dialog, &QInputDialog::textValueSelected, this, [answered](const QString& text) {
    if (!text.trimmed().isEmpty()) answered(text.trimmed());
  });
  dialog->show();
}

void Dock::robotLoaded() {
  for (Tab* tab : all_) tab->robotLoaded();
}
void Dock::robotGone() {
  for (Tab* tab : all_) tab->robotGone();
}
void Dock::moveGroupCame() {
  for (Tab* tab : all_) tab->moveGroupCame();
}
void Dock::moveGroupGone() {
  for (Tab* tab : all_) tab->moveGroupGone();
}
void Dock::groupChanged() {
  for (Tab* tab : all_) tab->groupChanged();
}
void Dock::queryChanged(Which which) {
  for (Tab* tab : all_) tab->queryChanged(which, false);
}
void Dock::queryDragged(Which which) {
  for (Tab* tab : all_) tab->queryChanged(which, true);
}
void Dock::sceneShown(const planning_scene::PlanningScene& scene) {
  for (Tab* tab : all_) tab->sceneShown(scene);
}
void Dock::load(const rviz::Config& config) {
  for (Tab* tab : all_) tab->load(config);
}
void Dock::save(rviz::Config config) const {
  for (const Tab* tab : all_) tab->save(config);
}

void Dock::warehouseChanged() {
  for (Tab* tab : all_) tab->warehouseChanged();
}

void Dock::update() {
  for (Tab* tab : all_) tab->update();
  progress_->setVisible(planning_->busy() || manipulation_->busy());
}

void Dock::markersCleared() { objects_->markerCleared(); }
void Dock::objectDragged(const Eigen::Isometry3d& pose) { objects_->dragged(pose); }
void Dock::setQueryTo(Which which, const std::string& state) { planning_->setQueryTo(which, state); }
void Dock::plan() { planning_->plan(); }
void Dock::execute() { planning_->execute(); }
void Dock::planAndExecute() { planning_->planAndExecute(); }
void Dock::stop() { planning_->stop(); }

}  // namespace moveit_rviz_plugin
