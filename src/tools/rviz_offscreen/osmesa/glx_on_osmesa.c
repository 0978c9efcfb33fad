/* GLX and the little of Xlib that OGRE's GL render system uses, on libOSMesa and without any X server.
 *
 * Preloaded before libOSMesa (LD_PRELOAD="libglx_on_osmesa.so libOSMesa.so.8") into an unmodified RViz that runs with
 * QT_QPA_PLATFORM=offscreen: Qt needs no X there, and what OGRE asks of Xlib and GLX is answered here. A drawable is a
 * pixel buffer in memory; making a context current binds that buffer; swapping finishes the drawing. There is no
 * multisampling. The OpenGL functions themselves are libOSMesa's.
 */
#include <GL/osmesa.h>
#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------------------ drawables */

enum { SCREEN_WIDTH = 4096, SCREEN_HEIGHT = 4096, ROOT_WINDOW = 1, FIRST_ID = 0x1000, DRAWABLES = 256 };

struct drawable {
    XID id; /* 0 = free */
    XID parent;
    int x, y;
    unsigned width, height;
    unsigned char *pixels; /* RGBA, row 0 at the bottom as OpenGL has it */
    unsigned pixels_width, pixels_height;
};

static struct drawable drawables[DRAWABLES];
static XID next_id = FIRST_ID;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static struct drawable *find(XID id)
{
    for (int i = 0; i < DRAWABLES; ++i)
        if (id && drawables[i].id == id)
            return &drawables[i];
    return NULL;
}

static XID create(XID parent, int x, int y, unsigned width, unsigned height)
{
    XID id = 0;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < DRAWABLES && !id; ++i) {
        if (drawables[i].id)
            continue;
        id = next_id++;
        drawables[i] = (struct drawable){.id = id, .parent = parent, .x = x, .y = y,
                                         .width = width ? width : 1, .height = height ? height : 1};
    }
    pthread_mutex_unlock(&lock);
    if (!id)
        fprintf(stderr, "glx_on_osmesa: more than %d windows at once\n", DRAWABLES);
    return id;
}

static void destroy(XID id)
{
    pthread_mutex_lock(&lock);
    struct drawable *d = find(id);
    if (d) {
        free(d->pixels);
        memset(d, 0, sizeof *d);
    }
    pthread_mutex_unlock(&lock);
}

/* ------------------------------------------------------------------------------------------------ the display */

static Visual visual = {.visualid = 0x21, .class = TrueColor, .red_mask = 0xff0000, .green_mask = 0xff00,
                        .blue_mask = 0xff, .bits_per_rgb = 8, .map_entries = 256};
static Depth depth = {.depth = 24, .nvisuals = 1, .visuals = &visual};
static Screen screen = {.root = ROOT_WINDOW, .width = SCREEN_WIDTH, .height = SCREEN_HEIGHT, .mwidth = 1000,
                        .mheight = 1000, .ndepths = 1, .depths = &depth, .root_depth = 24, .root_visual = &visual,
                        .cmap = 1, .white_pixel = 0xffffff, .max_maps = 1, .min_maps = 1};
/* The macros of Xlib.h read the public head of the display; room behind it for what is private to Xlib. */
static union {
    struct {
        __typeof__(*(_XPrivDisplay)0) head;
    } public;
    char room[4096];
} display;
static char display_name[] = "osmesa";
static char vendor[] = "glx_on_osmesa";

Display *XOpenDisplay(const char *name)
{
    (void)name;
    display.public.head.fd = -1;
    display.public.head.proto_major_version = 11;
    display.public.head.vendor = vendor;
    display.public.head.display_name = display_name;
    display.public.head.nscreens = 1;
    display.public.head.screens = &screen;
    display.public.head.byte_order = LSBFirst;
    display.public.head.bitmap_unit = 32;
    display.public.head.bitmap_pad = 32;
    screen.display = (Display *)&display;
    return (Display *)&display;
}

int XCloseDisplay(Display *d) { (void)d; return 0; }
char *XDisplayName(const char *name) { (void)name; return display_name; }
int XFlush(Display *d) { (void)d; return 0; }
int XSync(Display *d, Bool discard) { (void)d; (void)discard; return 0; }
int XFree(void *data) { free(data); return 1; }
XErrorHandler XSetErrorHandler(XErrorHandler handler) { (void)handler; return NULL; }

int XGetErrorText(Display *d, int code, char *buffer, int length)
{
    (void)d;
    return snprintf(buffer, length > 0 ? (size_t)length : 0, "X error %d", code);
}

Bool XQueryExtension(Display *d, const char *name, int *opcode, int *event, int *error)
{
    (void)d; (void)name;
    *opcode = *event = *error = 0;
    return False;
}

Atom XInternAtom(Display *d, const char *name, Bool only_if_exists)
{
    /* Any stable non-zero number will do: nobody is there to send messages to. */
    Atom atom = 5381;
    (void)d; (void)only_if_exists;
    for (; *name; ++name)
        atom = (atom * 33 + (unsigned char)*name) & 0xffffff;
    return atom + 1;
}

Colormap XCreateColormap(Display *d, Window w, Visual *v, int alloc) { (void)d; (void)w; (void)v; (void)alloc; return 1; }
VisualID XVisualIDFromVisual(Visual *v) { return v->visualid; }
XSizeHints *XAllocSizeHints(void) { return calloc(1, sizeof(XSizeHints)); }
XWMHints *XAllocWMHints(void) { return calloc(1, sizeof(XWMHints)); }

void XSetWMProperties(Display *d, Window w, XTextProperty *name, XTextProperty *icon, char **argv, int argc,
                      XSizeHints *size, XWMHints *hints, XClassHint *class_hint)
{
    (void)d; (void)w; (void)name; (void)icon; (void)argv; (void)argc; (void)size; (void)hints; (void)class_hint;
}

Status XSetWMProtocols(Display *d, Window w, Atom *protocols, int count)
{
    (void)d; (void)w; (void)protocols; (void)count;
    return 1;
}

Status XStringListToTextProperty(char **list, int count, XTextProperty *property)
{
    (void)list; (void)count;
    memset(property, 0, sizeof *property);
    return 1;
}

Status XSendEvent(Display *d, Window w, Bool propagate, long mask, XEvent *event)
{
    (void)d; (void)w; (void)propagate; (void)mask; (void)event;
    return 1;
}

/* ------------------------------------------------------------------------------------------------ windows */

Window XCreateWindow(Display *d, Window parent, int x, int y, unsigned width, unsigned height, unsigned border,
                     int depth_, unsigned class_, Visual *v, unsigned long mask, XSetWindowAttributes *attributes)
{
    (void)d; (void)border; (void)depth_; (void)class_; (void)v; (void)mask; (void)attributes;
    return create(parent, x, y, width, height);
}

Window XCreateSimpleWindow(Display *d, Window parent, int x, int y, unsigned width, unsigned height, unsigned border,
                           unsigned long border_pixel, unsigned long background)
{
    (void)d; (void)border; (void)border_pixel; (void)background;
    return create(parent, x, y, width, height);
}

int XDestroyWindow(Display *d, Window w) { (void)d; destroy(w); return 1; }
int XMapWindow(Display *d, Window w) { (void)d; (void)w; return 1; }
int XUnmapWindow(Display *d, Window w) { (void)d; (void)w; return 1; }

int XMoveWindow(Display *d, Window w, int x, int y)
{
    struct drawable *window = find(w);
    (void)d;
    if (window) {
        window->x = x;
        window->y = y;
    }
    return 1;
}

static void bind_current(void);

int XResizeWindow(Display *d, Window w, unsigned width, unsigned height)
{
    struct drawable *window = find(w);
    (void)d;
    if (window && width && height) {
        window->width = width;
        window->height = height;
        bind_current();
    }
    return 1;
}

Status XGetWindowAttributes(Display *d, Window w, XWindowAttributes *a)
{
    /* A window not made here is one of Qt's offscreen ones, which exist in Qt alone: as large as the screen. */
    const struct drawable *window = find(w);
    (void)d;
    memset(a, 0, sizeof *a);
    a->width = window ? (int)window->width : SCREEN_WIDTH;
    a->height = window ? (int)window->height : SCREEN_HEIGHT;
    a->x = window ? window->x : 0;
    a->y = window ? window->y : 0;
    a->depth = 24;
    a->visual = &visual;
    a->root = ROOT_WINDOW;
    a->class = InputOutput;
    a->map_state = IsViewable;
    a->screen = &screen;
    a->colormap = 1;
    return 1;
}

Status XQueryTree(Display *d, Window w, Window *root, Window *parent, Window **children, unsigned *count)
{
    const struct drawable *window = find(w);
    (void)d;
    *root = ROOT_WINDOW;
    *parent = window ? window->parent : ROOT_WINDOW;
    *children = NULL;
    *count = 0;
    return 1;
}

/* ------------------------------------------------------------------------------------------------ GLX */

struct context {
    OSMesaContext mesa;
};

struct __GLXFBConfigRec {
    int id;
};
static struct __GLXFBConfigRec the_config = {1};

static __thread struct context *current_context;
static __thread XID current_drawable;

static XVisualInfo *visual_info(void)
{
    XVisualInfo *info = calloc(1, sizeof *info);
    if (info)
        *info = (XVisualInfo){.visual = &visual, .visualid = visual.visualid, .depth = 24, .class = TrueColor,
                              .red_mask = visual.red_mask, .green_mask = visual.green_mask,
                              .blue_mask = visual.blue_mask, .colormap_size = 256, .bits_per_rgb = 8};
    return info;
}

static GLXFBConfig *one_config(int *count)
{
    GLXFBConfig *list = calloc(1, sizeof *list);
    if (list)
        list[0] = &the_config;
    *count = list ? 1 : 0;
    return list;
}

Bool glXQueryExtension(Display *d, int *error, int *event) { (void)d; if (error) *error = 0; if (event) *event = 0; return True; }
Bool glXQueryVersion(Display *d, int *major, int *minor) { (void)d; *major = 1; *minor = 4; return True; }
const char *glXGetClientString(Display *d, int name) { (void)d; return name == GLX_EXTENSIONS ? "" : name == GLX_VERSION ? "1.4" : vendor; }
const char *glXQueryServerString(Display *d, int s, int name) { (void)s; return glXGetClientString(d, name); }
const char *glXQueryExtensionsString(Display *d, int s) { (void)d; (void)s; return ""; }
XVisualInfo *glXChooseVisual(Display *d, int s, int *list) { (void)d; (void)s; (void)list; return visual_info(); }
XVisualInfo *glXGetVisualFromFBConfig(Display *d, GLXFBConfig c) { (void)d; (void)c; return visual_info(); }
GLXFBConfig *glXGetFBConfigs(Display *d, int s, int *count) { (void)d; (void)s; return one_config(count); }
GLXFBConfig *glXChooseFBConfig(Display *d, int s, const int *list, int *count) { (void)d; (void)s; (void)list; return one_config(count); }

static int attribute(int name)
{
    switch (name) {
    case GLX_RED_SIZE: case GLX_GREEN_SIZE: case GLX_BLUE_SIZE: case GLX_ALPHA_SIZE: case GLX_STENCIL_SIZE: return 8;
    case GLX_DEPTH_SIZE: return 24;
    case GLX_BUFFER_SIZE: return 32;
    case GLX_DOUBLEBUFFER: case GLX_RGBA: case GLX_USE_GL: case GLX_X_RENDERABLE: return 1;
    case GLX_DRAWABLE_TYPE: return GLX_WINDOW_BIT | GLX_PBUFFER_BIT;
    case GLX_RENDER_TYPE: return GLX_RGBA_BIT;
    case GLX_X_VISUAL_TYPE: return GLX_TRUE_COLOR;
    case GLX_CONFIG_CAVEAT: case GLX_TRANSPARENT_TYPE: return GLX_NONE;
    case GLX_VISUAL_ID: return (int)visual.visualid;
    case GLX_FBCONFIG_ID: return the_config.id;
    default: return 0; /* GLX_SAMPLES among them: OSMesa has no multisampling */
    }
}

int glXGetFBConfigAttrib(Display *d, GLXFBConfig c, int name, int *value) { (void)d; (void)c; *value = attribute(name); return Success; }
int glXGetConfig(Display *d, XVisualInfo *v, int name, int *value) { (void)d; (void)v; *value = attribute(name); return Success; }

static GLXContext new_context(GLXContext share)
{
    struct context *context = calloc(1, sizeof *context);
    if (!context)
        return NULL;
    context->mesa = OSMesaCreateContextExt(OSMESA_RGBA, 24, 8, 0, share ? ((struct context *)share)->mesa : NULL);
    if (!context->mesa) {
        fprintf(stderr, "glx_on_osmesa: OSMesa made no context\n");
        free(context);
        return NULL;
    }
    return (GLXContext)context;
}

GLXContext glXCreateContext(Display *d, XVisualInfo *v, GLXContext share, Bool direct) { (void)d; (void)v; (void)direct; return new_context(share); }
GLXContext glXCreateNewContext(Display *d, GLXFBConfig c, int type, GLXContext share, Bool direct) { (void)d; (void)c; (void)type; (void)direct; return new_context(share); }

void glXDestroyContext(Display *d, GLXContext c)
{
    struct context *context = (struct context *)c;
    (void)d;
    if (!context)
        return;
    if (context == current_context) {
        OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
        current_context = NULL;
    }
    OSMesaDestroyContext(context->mesa);
    free(context);
}

/* Binds the current context to its drawable's buffer, made anew when the drawable has been resized. */
static Bool bind(struct context *context, XID id)
{
    struct drawable *d = find(id);
    if (!d && !(d = find(id = create(ROOT_WINDOW, 0, 0, 64, 64))))
        return False;
    if (!d->pixels || d->pixels_width != d->width || d->pixels_height != d->height) {
        unsigned char *pixels = calloc((size_t)d->width * d->height, 4);
        if (!pixels)
            return False;
        free(d->pixels);
        d->pixels = pixels;
        d->pixels_width = d->width;
        d->pixels_height = d->height;
    }
    if (!OSMesaMakeCurrent(context->mesa, d->pixels, GL_UNSIGNED_BYTE, (GLsizei)d->width, (GLsizei)d->height))
        return False;
    OSMesaPixelStore(OSMESA_Y_UP, 1);
    current_context = context;
    current_drawable = id;
    return True;
}

static void bind_current(void)
{
    if (current_context)
        bind(current_context, current_drawable);
}

Bool glXMakeCurrent(Display *d, GLXDrawable drawable, GLXContext c)
{
    struct context *context = (struct context *)c;
    (void)d;
    if (!context) {
        if (current_context)
            OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
        current_context = NULL;
        current_drawable = 0;
        return True;
    }
    if (context == current_context && drawable == current_drawable) {
        const struct drawable *same = find(drawable);
        if (same && same->pixels_width == same->width && same->pixels_height == same->height)
            return True; /* OGRE does this before every batch; rebinding would flush each time */
    }
    return bind(context, drawable);
}

Bool glXMakeContextCurrent(Display *d, GLXDrawable draw, GLXDrawable read, GLXContext c) { (void)read; return glXMakeCurrent(d, draw, c); }
GLXContext glXGetCurrentContext(void) { return (GLXContext)current_context; }
GLXDrawable glXGetCurrentDrawable(void) { return current_drawable; }
Display *glXGetCurrentDisplay(void) { return (Display *)&display; }
Bool glXIsDirect(Display *d, GLXContext c) { (void)d; (void)c; return True; }
void glXSwapBuffers(Display *d, GLXDrawable drawable) { (void)d; (void)drawable; glFinish(); }
void glXWaitGL(void) {}
void glXWaitX(void) {}

int glXQueryContext(Display *d, GLXContext c, int name, int *value)
{
    (void)d; (void)c;
    *value = name == GLX_FBCONFIG_ID ? the_config.id : name == GLX_RENDER_TYPE ? GLX_RGBA_TYPE : 0;
    return Success;
}

void glXQueryDrawable(Display *d, GLXDrawable drawable, int name, unsigned *value)
{
    const struct drawable *window = find(drawable);
    (void)d;
    *value = !window ? 0 : name == GLX_WIDTH ? window->width : name == GLX_HEIGHT ? window->height
             : name == GLX_FBCONFIG_ID ? (unsigned)the_config.id : 0;
}

GLXPbuffer glXCreatePbuffer(Display *d, GLXFBConfig c, const int *list)
{
    unsigned width = 1, height = 1;
    (void)d; (void)c;
    for (; list && list[0]; list += 2) {
        if (list[0] == GLX_PBUFFER_WIDTH)
            width = (unsigned)list[1];
        if (list[0] == GLX_PBUFFER_HEIGHT)
            height = (unsigned)list[1];
    }
    return create(ROOT_WINDOW, 0, 0, width, height);
}

void glXDestroyPbuffer(Display *d, GLXPbuffer p) { (void)d; destroy(p); }

/* OGRE stops with an exception when no swap interval function exists; there is no retrace to wait for. */
static int swap_interval(int interval) { (void)interval; return 0; }
static void swap_interval_ext(Display *d, GLXDrawable drawable, int interval) { (void)d; (void)drawable; (void)interval; }

#define OWN(name) {#name, (__GLXextFuncPtr)name}
__GLXextFuncPtr glXGetProcAddressARB(const GLubyte *name)
{
    static const struct { const char *name; __GLXextFuncPtr function; } own[] = {
        OWN(glXQueryExtension), OWN(glXQueryVersion), OWN(glXGetClientString), OWN(glXQueryServerString),
        OWN(glXQueryExtensionsString), OWN(glXChooseVisual), OWN(glXGetVisualFromFBConfig), OWN(glXGetFBConfigs),
        OWN(glXChooseFBConfig), OWN(glXGetFBConfigAttrib), OWN(glXGetConfig), OWN(glXCreateContext),
        OWN(glXCreateNewContext), OWN(glXDestroyContext), OWN(glXMakeCurrent), OWN(glXMakeContextCurrent),
        OWN(glXGetCurrentContext), OWN(glXGetCurrentDrawable), OWN(glXGetCurrentDisplay), OWN(glXIsDirect),
        OWN(glXSwapBuffers), OWN(glXWaitGL), OWN(glXWaitX), OWN(glXQueryContext), OWN(glXQueryDrawable),
        OWN(glXCreatePbuffer), OWN(glXDestroyPbuffer),
        {"glXSwapIntervalMESA", (__GLXextFuncPtr)swap_interval},
        {"glXSwapIntervalSGI", (__GLXextFuncPtr)swap_interval},
        {"glXSwapIntervalEXT", (__GLXextFuncPtr)swap_interval_ext},
    };
    for (size_t i = 0; i < sizeof own / sizeof own[0]; ++i)
        if (!strcmp((const char *)name, own[i].name))
            return own[i].function;
    /* Any other GLX function (glXCreateContextAttribsARB above all) must seem absent, or libGL's own would be used. */
    if (!strncmp((const char *)name, "glX", 3))
        return NULL;
    return (__GLXextFuncPtr)OSMesaGetProcAddress((const char *)name);
}

__GLXextFuncPtr glXGetProcAddress(const GLubyte *name) { return glXGetProcAddressARB(name); }
