/* What ODE alone costs: the benchmark's bodies in a plain C loop of collide, step, read. Prints microseconds and contacts per step.
   usage: bare_ode arm|boxes|robots STEPS [JOINTS OF THE ARM | ROBOTS] */
#include <math.h>
#include <ode/ode.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static dWorldID world;
static dSpaceID space;
static dJointGroupID contacts;
static long made = 0;
static int slick; /* its address marks geoms without friction */

static double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void near_callback(void *data, dGeomID a, dGeomID b) {
  (void)data;
  dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
  if (first && second && dAreConnected(first, second)) return;
  dContact c[10];
  int n = dCollide(a, b, 10, &c[0].geom, sizeof(dContact));
  made += n;
  for (int i = 0; i < n; ++i) {
    c[i].surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM;
    c[i].surface.mu = dGeomGetData(a) == &slick || dGeomGetData(b) == &slick ? 0 : 1;
    c[i].surface.soft_erp = 0.2;
    c[i].surface.soft_cfm = 1e-5;
    dJointAttach(dJointCreateContact(world, contacts, &c[i]), first, second);
  }
}

static dBodyID box(double x, double y, double z, double sx, double sy, double sz, double mass) {
  dBodyID body = dBodyCreate(world);
  dMass m;
  dMassSetBoxTotal(&m, mass, sx, sy, sz);
  dBodySetMass(body, &m);
  dBodySetPosition(body, x, y, z);
  dGeomSetBody(dCreateBox(space, sx, sy, sz), body);
  return body;
}

/* The body `diff_drive` of ode_sim's tests: two driven wheels, two casters without friction. Joints: of the wheels. */
static void robot(double x, double y, dJointID *joints) {
  dBodyID base = box(x, y, 0.07, 0.3, 0.25, 0.1, 5);
  dGeomDestroy(dBodyGetFirstGeom(base));
  dGeomID body = dCreateCylinder(space, 0.14, 0.06);
  dGeomSetBody(body, base);
  dGeomSetOffsetPosition(body, 0, 0, 0.03);
  for (int i = 0; i < 2; ++i) {
    dGeomID caster = dCreateSphere(space, 0.02);
    dGeomSetBody(caster, base);
    dGeomSetOffsetPosition(caster, i ? -0.12 : 0.12, 0, -0.05);
    dGeomSetData(caster, &slick);
  }
  for (int i = 0; i < 2; ++i) {
    dBodyID wheel = dBodyCreate(world);
    dMass m;
    dMassSetCylinderTotal(&m, 0.3, 3, 0.05, 0.03);
    dBodySetMass(wheel, &m);
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 1, 0, 0, M_PI / 2);
    dBodySetRotation(wheel, turned);
    dBodySetPosition(wheel, x, y + (i ? -0.15 : 0.15), 0.05);
    dGeomSetBody(dCreateCylinder(space, 0.05, 0.03), wheel);
    joints[i] = dJointCreateHinge(world, 0);
    dJointAttach(joints[i], wheel, base);
    dJointSetHingeAnchor(joints[i], x, y + (i ? -0.15 : 0.15), 0.05);
    dJointSetHingeAxis(joints[i], 0, 1, 0);
    dJointSetHingeParam(joints[i], dParamFMax, 5);
    dJointSetHingeParam(joints[i], dParamVel, 5);
  }
}

int main(int argc, char **argv) {
  if (argc < 3) return 2;
  const int arm = !strcmp(argv[1], "arm"), robots = !strcmp(argv[1], "robots"), steps = atoi(argv[2]), count = argc > 3 ? atoi(argv[3]) : 6;
  if (count < 1 || count > 16) return 2;
  dInitODE2(0);
  world = dWorldCreate();
  space = dHashSpaceCreate(0);
  contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, -9.8);
  dCreatePlane(space, 0, 0, 1, 0);
  dJointID joints[32];
  const int hinges = arm ? count : robots ? 2 * count : 0;
  double sum = 0;
  if (arm) {
    dBodyID last = 0;
    for (int i = 0; i < count; ++i) {
      dBodyID link = box(0, 0, 0.2 + 0.2 * i, 0.05, 0.05, 0.2, 1);
      joints[i] = dJointCreateHinge(world, 0);
      dJointAttach(joints[i], link, last);
      dJointSetHingeAnchor(joints[i], 0, 0, 0.1 + 0.2 * i);
      dJointSetHingeAxis(joints[i], 0, i > 0, i == 0);
      dJointSetHingeParam(joints[i], dParamFMax, 100);
      dJointSetHingeParam(joints[i], dParamVel, 0.02);
      last = link;
    }
  } else if (robots) {
    for (int i = 0; i < count; ++i) robot(0, 1.0 * i, joints + 2 * i);
  } else {
    dWorldSetAutoDisableFlag(world, 1);
    dWorldSetAutoDisableLinearThreshold(world, 0.1);
    dWorldSetAutoDisableAngularThreshold(world, 0.1);
    dWorldSetAutoDisableTime(world, 1);
    dWorldSetQuickStepNumIterations(world, 50);
    for (int i = 0; i < 100; ++i) box(0.15 * (i % 3) + 0.01 * (i % 7), 0.15 * (i / 3 % 3), 0.1 + 0.12 * (i / 9), 0.1, 0.1, 0.1, 1);
  }
  const double start = now();
  for (int k = 0; k < steps; ++k) {
    dSpaceCollide(space, 0, near_callback);
    if (hinges) dWorldStep(world, 0.001); else dWorldQuickStep(world, 0.001);
    dJointGroupEmpty(contacts);
    for (int i = 0; i < hinges; ++i)
      sum += dJointGetHingeAngle(joints[i]) + dJointGetHingeAngleRate(joints[i]);
  }
  printf("%.3f %.1f\n", (now() - start) / steps * 1e6, (double)made / steps);
  return isnan(sum);
}
