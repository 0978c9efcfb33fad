#include "context_tab.hpp"

#include <moveit_msgs/GetPlannerParams.h>
#include <moveit_msgs/QueryPlannerInterfaces.h>
#include <moveit_msgs/SetPlannerParams.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <ros/service.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGroupBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QVBoxLayout>

#include "stored_tabs.hpp"
#include "warehouse.hpp"

namespace moveit_rviz_plugin {
namespace {
const char* const UNSPECIFIED = "<unspecified>";
const char* const NOTHING = "NO PLANNING LIBRARY LOADED";
const char* const AXES[] = {"x", "y", "z"};
const char* const KEYS[] = {"X", "Y", "Z"};
}  // namespace

ContextTab::ContextTab(Dock* dock) : Tab(dock) {
  setObjectName("context");
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(makeLibrary(), 1);
  layout->addWidget(makeWarehouse());
  layout->addWidget(makeWorkspace());
  moveGroupGone();
}

QWidget* ContextTab::makeLibrary() {
  auto* box = new QGroupBox("Planning Library");
  auto* layout = new QGridLayout(box);
  library_ = new QLabel;
  library_->setObjectName("library_label");
  pipelines_ = new QComboBox;
  pipelines_->setObjectName("planning_pipeline_combo_box");
  planners_ = new QComboBox;
  planners_->setObjectName("planning_algorithm_combo_box");
  parameters_ = new QTableWidget(0, 2);
  parameters_->setObjectName("planner_param_treeview");
  parameters_->setHorizontalHeaderLabels({"Planner Parameter", "Value"});
  parameters_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  parameters_->verticalHeader()->hide();
  layout->addWidget(library_, 0, 0);
  layout->addWidget(pipelines_, 1, 0);
  layout->addWidget(planners_, 2, 0);
  layout->setRowStretch(3, 1);
  layout->addWidget(parameters_, 0, 1, 4, 1);
  layout->setColumnStretch(0, 2);
  layout->setColumnStretch(1, 3);
  connect(pipelines_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int) { fillPlanners(); });
  connect(planners_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int) { askParameters(); });
  connect(parameters_, &QTableWidget::cellChanged, this, [this](int, int) { sendParameters(); });
  return box;
}

QWidget* ContextTab::makeWarehouse() {
  auto* box = new QGroupBox("Warehouse");
  box->setToolTip("Stored scenes and states are kept in a file; no server is needed. Host may be the path of one");
  auto* layout = new QHBoxLayout(box);
  host_ = new QLineEdit;
  host_->setObjectName("database_host");
  host_->setPlaceholderText("this system's file, or a path");
  port_ = new QSpinBox;
  port_->setObjectName("database_port");
  port_->setRange(0, 65535);
  port_->setToolTip("Not needed");
  reset_ = new QPushButton("Reset database ...");
  reset_->setObjectName("reset_db_button");
  connect_ = new QPushButton("Connect");
  connect_->setObjectName("database_connect_button");
  for (QWidget* widget :
       std::initializer_list<QWidget*>{new QLabel("Host:"), host_, new QLabel("Port:"), port_, reset_, connect_})
    layout->addWidget(widget);
  connect(connect_, &QPushButton::clicked, this, [this](bool) { connectWarehouse(); });
  connect(reset_, &QPushButton::clicked, this, [this](bool) {
    dock_->ask("Reset database", "Everything of one kind is forgotten. Which? states, scenes or constraints", "",
               [this](const QString& kind) {
                 const std::string table = kind.toStdString();
                 if (table != "states" && table != "scenes" && table != "constraints")
                   return dock_->say("there are states, scenes and constraints, not '" + table + "'", true);
                 dock_->inBackground([this, table]() {
                   dock_->warehouse().clear(table);
                   if (table == "scenes") {
                     dock_->warehouse().clear("requests");
                     dock_->warehouse().clear("results");
                   }
                   dock_->say("All " + table + " of " + dock_->warehouse().file() + " were removed");
                 });
               });
  });
  return box;
}

QWidget* ContextTab::makeWorkspace() {
  auto* box = new QGroupBox("Workspace");
  auto* layout = new QGridLayout(box);
  layout->addWidget(new QLabel("Center (XYZ):"), 0, 0);
  layout->addWidget(new QLabel("Size (XYZ):"), 1, 0);
  for (int i = 0; i < 3; ++i) {
    centre_[i] = new QDoubleSpinBox;
    size_[i] = new QDoubleSpinBox;
    centre_[i]->setObjectName(QString("wcenter_") + AXES[i]);
    size_[i]->setObjectName(QString("wsize_") + AXES[i]);
    centre_[i]->setRange(-10000.0, 10000.0);
    size_[i]->setRange(0.0, 10000.0);
    size_[i]->setValue(2.0);
    for (QDoubleSpinBox* number : {centre_[i], size_[i]})
      connect(number, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double) { workspaceChanged(); });
    layout->addWidget(centre_[i], 0, i + 1);
    layout->addWidget(size_[i], 1, i + 1);
  }
  return box;
}

void ContextTab::workspaceChanged() {
  dock_->display().setWorkspace(Eigen::Vector3d(centre_[0]->value(), centre_[1]->value(), centre_[2]->value()),
                                Eigen::Vector3d(size_[0]->value(), size_[1]->value(), size_[2]->value()));
}

moveit_msgs::WorkspaceParameters ContextTab::workspace() const {
  moveit_msgs::WorkspaceParameters box;
  if (const auto model = dock_->display().model()) box.header.frame_id = model->getModelFrame();
  const auto fill = [this](geometry_msgs::Vector3& corner, double side) {
    corner.x = centre_[0]->value() + side * size_[0]->value() / 2.0;
    corner.y = centre_[1]->value() + side * size_[1]->value() / 2.0;
    corner.z = centre_[2]->value() + side * size_[2]->value() / 2.0;
  };
  fill(box.min_corner, -1.0);
  fill(box.max_corner, 1.0);
  return box;
}

void ContextTab::load(const rviz::Config& config) {
  const rviz::Config workspace = config.mapGetChild("MoveIt_Workspace");
  const rviz::Config centre = workspace.mapGetChild("Center"), size = workspace.mapGetChild("Size");
  float value;
  double edge;
  std::string key;
  const bool usual = !size.isValid() && ros::param::get(dock_->display().named("move_group/default_workspace_bounds"), edge);
  for (int i = 0; i < 3; ++i) {
    if (centre.mapGetFloat(KEYS[i], &value)) centre_[i]->setValue(value);
    if (size.mapGetFloat(KEYS[i], &value)) size_[i]->setValue(value);
    else if (usual) size_[i]->setValue(edge);
  }
  QString host;
  if (config.mapGetString("MoveIt_Warehouse_Host", &host)) host_->setText(host);
  int port;
  if (config.mapGetInt("MoveIt_Warehouse_Port", &port)) port_->setValue(port);
}

void ContextTab::save(rviz::Config config) const {
  rviz::Config workspace = config.mapMakeChild("MoveIt_Workspace");
  rviz::Config centre = workspace.mapMakeChild("Center"), size = workspace.mapMakeChild("Size");
  for (int i = 0; i < 3; ++i) {
    centre.mapSetValue(KEYS[i], centre_[i]->value());
    size.mapSetValue(KEYS[i], size_[i]->value());
  }
  if (!host_->text().isEmpty()) config.mapSetValue("MoveIt_Warehouse_Host", host_->text());
  if (port_->value()) config.mapSetValue("MoveIt_Warehouse_Port", port_->value());
}

// ---------------------------------------------------------------- the planning library

std::string ContextTab::pipeline() const {
  const int index = pipelines_->currentIndex();
  return index >= 0 && index < static_cast<int>(found_.size()) ? found_[static_cast<std::size_t>(index)].pipeline_id : "";
}

std::string ContextTab::planner() const {
  const std::string text = planners_->currentText().toStdString();
  return text == UNSPECIFIED ? "" : text;
}

void ContextTab::robotGone() { moveGroupGone(); }

void ContextTab::moveGroupGone() {
  fillPipelines({}, "");
  library_->setText(NOTHING);
  library_->setStyleSheet("QLabel { color: red; font: bold }");
}

void ContextTab::moveGroupCame() {
  const std::string service = dock_->display().named("query_planner_interface");
  const std::string parameter = dock_->display().named("move_group/default_planning_pipeline");
  dock_->inBackground([this, service, parameter]() {
    moveit_msgs::QueryPlannerInterfaces call;
    for (int i = 0; i < 50 && !ros::service::exists(service, false); ++i) ros::WallDuration(0.1).sleep();
    if (!ros::service::call(service, call))
      throw std::runtime_error("nobody answers " + service + ": no planner can be chosen");
    std::string usual;
    ros::param::get(parameter, usual);
    dock_->later([this, found = call.response.planner_interfaces, usual]() { fillPipelines(found, usual); });
  });
}

void ContextTab::fillPipelines(const std::vector<moveit_msgs::PlannerInterfaceDescription>& found, const std::string& usual) {
  filling_ = true;
  found_ = found;
  pipelines_->clear();
  int index = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    pipelines_->addItem(QString::fromStdString(found[i].pipeline_id.empty() ? found[i].name : found[i].pipeline_id));
    if (found[i].pipeline_id == usual) index = static_cast<int>(i);
  }
  pipelines_->setCurrentIndex(found.empty() ? -1 : index);
  filling_ = false;
  fillPlanners();
}

void ContextTab::groupChanged() { fillPlanners(); }

void ContextTab::fillPlanners() {
  if (filling_) return;
  filling_ = true;
  planners_->clear();
  const int index = pipelines_->currentIndex();
  const std::string group = dock_->display().group();
  if (index >= 0 && index < static_cast<int>(found_.size())) {
    const moveit_msgs::PlannerInterfaceDescription& library = found_[static_cast<std::size_t>(index)];
    library_->setText(QString::fromStdString(library.name));
    library_->setStyleSheet("QLabel { color: green; font: bold }");
    planners_->addItem(UNSPECIFIED);
    bool of_group = false;
    for (const std::string& id : library.planner_ids) {  // "group" and "group[planner]"
      of_group = of_group || id == group;
      if (id.size() > group.size() + 2 && id.compare(0, group.size() + 1, group + "[") == 0)
        planners_->addItem(QString::fromStdString(id.substr(group.size() + 1, id.size() - group.size() - 2)));
    }
    if (planners_->count() == 1 && !of_group)
      for (const std::string& id : library.planner_ids) planners_->addItem(QString::fromStdString(id));
    std::string usual;
    for (const std::string& place :
         {"move_group/planning_pipelines/" + library.pipeline_id + "/" + group, "move_group/" + group})
      if (ros::param::get(dock_->display().named(place + "/default_planner_config"), usual)) break;
    planners_->setCurrentIndex(std::max(0, planners_->findText(QString::fromStdString(usual))));
  }
  filling_ = false;
  askParameters();
}

void ContextTab::askParameters() {
  if (filling_) return;
  showParameters({});
  moveit_msgs::GetPlannerParams call;
  call.request.pipeline_id = pipeline();
  call.request.planner_config = planner();
  call.request.group = dock_->display().group();
  const std::string service = dock_->display().named("get_planner_params");
  if (call.request.planner_config.empty() || !dock_->display().moveGroupThere()) return;
  dock_->inBackground([this, service, call]() mutable {
    if (!ros::service::call(service, call)) return;
    std::map<std::string, std::string> parameters;
    for (std::size_t i = 0; i < call.response.params.keys.size() && i < call.response.params.values.size(); ++i)
      parameters[call.response.params.keys[i]] = call.response.params.values[i];
    dock_->later([this, parameters]() { showParameters(parameters); });
  });
}

void ContextTab::showParameters(const std::map<std::string, std::string>& parameters) {
  filling_ = true;
  parameters_->setRowCount(static_cast<int>(parameters.size()));
  int row = 0;
  for (const auto& item : parameters) {
    auto* key = new QTableWidgetItem(QString::fromStdString(item.first));
    key->setFlags(key->flags() & ~Qt::ItemIsEditable);
    parameters_->setItem(row, 0, key);
    parameters_->setItem(row++, 1, new QTableWidgetItem(QString::fromStdString(item.second)));
  }
  filling_ = false;
}

void ContextTab::sendParameters() {
  if (filling_) return;
  moveit_msgs::SetPlannerParams call;
  call.request.pipeline_id = pipeline();
  call.request.planner_config = planner();
  call.request.group = dock_->display().group();
  for (int row = 0; row < parameters_->rowCount(); ++row) {
    call.request.params.keys.push_back(parameters_->item(row, 0)->text().toStdString());
    call.request.params.values.push_back(parameters_->item(row, 1)->text().toStdString());
  }
  const std::string service = dock_->display().named("set_planner_params");
  dock_->inBackground([service, call]() mutable {
    if (!ros::service::call(service, call)) throw std::runtime_error(service + " did not take the planner's parameters");
  });
}

void ContextTab::connectWarehouse() {
  const std::string host = host_->text().toStdString();
  dock_->inBackground([this, host]() {
    dock_->useWarehouse(host);
    const std::string file = dock_->warehouse().file();
    dock_->say("Stored scenes and states are in " + file);
    dock_->later([this, file]() { connect_->setToolTip(QString::fromStdString(file)); });
    dock_->later([this]() { dock_->warehouseChanged(); });
  });
}

}  // namespace moveit_rviz_plugin
