package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.Controls;
import io.natator.checkpoint.SwimSample;
import io.natator.verdict.ControlVerdict;
import java.io.PrintWriter;
import java.util.stream.Collectors;

/** A winner's controls as a table, with the verdict. */
final class ControlReport {

    private final PrintWriter out;

    ControlReport(PrintWriter out) {
        this.out = out;
    }

    /** Prints it. */
    void print(Controls controls) {
        out.printf("%-26s%-22s%s%n", "distance in " + Numbers.fixed(controls.duration(), 2) + " s", "mean ± sd", "runs");
        line("in water", controls.water());
        line("with resting muscles", controls.resting());
        line("in vacuum", controls.vacuum());
        if (controls.clampOff() != null) {
            line("no acceleration clamp", controls.clampOff());
        }
        line("half the time step", controls.halfStep());
        line("mirrored", controls.mirrored());
        if (controls.otherBackend() == null) {
            out.printf("%-26s%s%n", "other backend", "not tried: this machine has no GPU, or the program does none");
        } else {
            line("on " + controls.backend(), controls.otherBackend());
        }
        if (controls.underWater() != null) {
            out.printf("%-26s%s %% of the body%n", "under water", Numbers.fixed(100 * controls.underWater(), 0));
        }
        out.println("verdict: " + ControlVerdict.of(controls).text());
        out.flush();
    }

    private void line(String what, SwimSample sample) {
        String ends = sample.stopped().entrySet().stream().map(one -> one.getValue() + " " + one.getKey())
                .collect(Collectors.joining(", "));
        out.printf("%-26s%-22s%s%n", what,
                Numbers.withError(sample.distance().mean(), sample.distance().sd(), RunReport.DIGITS), ends);
    }
}
