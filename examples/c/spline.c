/* A spline through a few points, its slope and its integral; and what a mistake is answered.
 *
 *     cc spline.c $(pkg-config --cflags --libs mechaudit) -o spline */
#include <mechaudit.h>
#include <stdio.h>

int main(void) {
    const double x[] = {0, 1, 2.5, 4}, y[] = {0, 1, 15.625, 64};
    mechaudit_spline *s;
    mechaudit_error e;
    if (mechaudit_spline_fit(4, x, y, MECHAUDIT_SPLINE_END_SECOND_DERIVATIVE, 0,
                             MECHAUDIT_SPLINE_END_SECOND_DERIVATIVE, 24, MECHAUDIT_SPLINE_OUTSIDE_REFUSE, &s,
                             &e) != MECHAUDIT_STATUS_OK) {
        fprintf(stderr, "%s\n", e.message);
        return 1;
    }
    double jet[4], area, beyond;
    mechaudit_spline_jet(s, 3, jet, NULL);
    mechaudit_spline_integral(s, 0, 4, &area, NULL);
    printf("S(3) %.15g, S'(3) %.15g, integral %.15g\n", jet[0], jet[1], area);
    if (mechaudit_spline_value(s, 5, &beyond, &e) != MECHAUDIT_STATUS_OK) {
        printf("refused: %s\n", e.message);
    }
    mechaudit_spline_free(s);
    return 0;
}
