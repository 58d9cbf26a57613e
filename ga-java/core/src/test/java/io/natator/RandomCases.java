package io.natator;

import java.lang.annotation.ElementType;
import java.lang.annotation.Retention;
import java.lang.annotation.RetentionPolicy;
import java.lang.annotation.Target;
import java.util.SplittableRandom;
import java.util.random.RandomGenerator;
import java.util.stream.LongStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.AnnotationBasedArgumentsProvider;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.ArgumentsSource;
import org.junit.jupiter.params.support.ParameterDeclarations;

/** A test of random cases, the same ones every time; it takes {@link Case}, whose seed is in the name of what fails. */
@Retention(RetentionPolicy.RUNTIME)
@Target(ElementType.METHOD)
@ParameterizedTest(name = "{0}")
@ArgumentsSource(RandomCases.Source.class)
public @interface RandomCases {

    /** How many. */
    int value();

    /**
     * The numbers of one case.
     *
     * @param seed   that gives them all
     * @param random for what is not drawn below
     */
    record Case(long seed, RandomGenerator random) {

        /** The case of a seed. */
        public Case(long seed) {
            this(seed, new SplittableRandom(seed));
        }

        /** From the least to the greatest. */
        public int whole(int least, int greatest) {
            return random.nextInt(least, greatest + 1);
        }

        /** From the least to the greatest; the bounds and 0 are likelier than by chance, since mistakes sit there. */
        public double number(double least, double greatest) {
            double[] edges = {least, greatest, Math.max(least, Math.min(0, greatest))};
            int choice = random.nextInt(5 * edges.length);
            return choice < edges.length ? edges[choice] : least + random.nextDouble() * (greatest - least);
        }

        @Override
        public String toString() {
            return "seed " + seed;
        }
    }

    /** Seeds from 0. */
    final class Source extends AnnotationBasedArgumentsProvider<RandomCases> {
        @Override
        protected Stream<? extends Arguments> provideArguments(ParameterDeclarations parameters,
                ExtensionContext context, RandomCases cases) {
            return LongStream.range(0, cases.value()).mapToObj(seed -> Arguments.of(new Case(seed)));
        }
    }
}
