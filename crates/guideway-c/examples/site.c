/* Opens a layout, says what is in it, checks it, and draws it as a picture in the format PPM:
 *
 *     cc site.c $(pkg-config --cflags --libs guideway) -o site
 *     ./site site.lif.json site.ppm
 */

#include <guideway.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *action)
{
    const GuidewayError *error = guideway_last_error();
    fprintf(stderr, "cannot %s: %s. %s\n", action, error->message, error->remedy);
    return EXIT_FAILURE;
}

static int32_t show(const GuidewayFinding *finding, void *user)
{
    int *count = user;
    *count += 1;
    printf("line %u, %s: %s. %s\n", finding->line, finding->element, finding->message,
           finding->remedy);
    return 0;
}

/* Draws the whole layout and writes its colors. */
static int draw(const GuidewayLayout *layout, const char *file)
{
    enum { WIDTH = 640, HEIGHT = 360, STRIDE = 4 * WIDTH };
    int result = EXIT_FAILURE;
    GuidewayView view;
    GuidewayReport report;
    GuidewayDrawing *drawing = guideway_drawing_new(layout, "maxSpeed", NULL);
    unsigned char *rgba = malloc((size_t)STRIDE * HEIGHT);
    FILE *out = fopen(file, "wb");
    if (!rgba || !out) {
        fprintf(stderr, "cannot write %s\n", file);
    } else if (!drawing || guideway_drawing_fit(drawing, WIDTH, HEIGHT, &view) ||
               guideway_drawing_render(drawing, &view, 0xffffffff, rgba, STRIDE, &report)) {
        result = fail("draw the layout");
    } else {
        fprintf(out, "P6 %d %d 255\n", WIDTH, HEIGHT);
        for (size_t pixel = 0; pixel < (size_t)WIDTH * HEIGHT; pixel++)
            fwrite(rgba + 4 * pixel, 3, 1, out);
        printf("%llu of %llu paths are in the picture\n", (unsigned long long)report.drawn,
               (unsigned long long)report.total);
        result = EXIT_SUCCESS;
    }
    if (out && fclose(out))
        result = EXIT_FAILURE;
    free(rgba);
    guideway_drawing_free(drawing);
    return result;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "write: site LAYOUT PICTURE.ppm\n");
        return EXIT_FAILURE;
    }
    printf("Guideway %s\n", guideway_version());
    GuidewayLayout *layout = guideway_layout_open(argv[1]);
    if (!layout)
        return fail("open the layout");

    int result = EXIT_FAILURE, findings = 0;
    char *info = guideway_layout_info(layout);
    if (info && guideway_layout_check(layout, show, &findings) == GUIDEWAY_STATUS_OK) {
        printf("%s\n%d findings\n", info, findings);
        result = draw(layout, argv[2]);
    } else {
        fail("describe the layout");
    }
    guideway_text_free(info);
    guideway_layout_free(layout);
    return result;
}
