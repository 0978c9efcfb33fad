/* What ODE alone costs: the benchmark's bodies in a plain C loop of collide, step, read. Prints microseconds and contacts per step.
   usage: bare_ode arm|boxes STEPS [JOINTS] */
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
    c[i].surface.mu = 1;
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

int main(int argc, char **argv) {
  if (argc < 3) return 2;
  const int arm = !strcmp(argv[1], "arm"), steps = atoi(argv[2]), count = argc > 3 ? atoi(argv[3]) : 6;
  if (count < 1 || count > 16) return 2;
  dInitODE2(0);
  world = dWorldCreate();
  space = dHashSpaceCreate(0);
  contacts = dJointGroupCreate(0);
  dWorldSetGravity(world, 0, 0, -9.8);
  dCreatePlane(space, 0, 0, 1, 0);
  dJointID joints[16];
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
    if (arm) dWorldStep(world, 0.001); else dWorldQuickStep(world, 0.001);
    dJointGroupEmpty(contacts);
    if (arm)
      for (int i = 0; i < count; ++i) sum += dJointGetHingeAngle(joints[i]) + dJointGetHingeAngleRate(joints[i]);
  }
  printf("%.3f %.1f\n", (now() - start) / steps * 1e6, (double)made / steps);
  return isnan(sum);
}
