package io.natator.evolution;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import org.jgap.GeneticOperator;
import org.jgap.IChromosome;
import org.jgap.InvalidConfigurationException;
import org.jgap.Population;
import org.junit.jupiter.api.Test;

class CrossoverAndMutationTest {

    private static final int SIZE = 150;
    private static final int GENES = 10;

    private final JgapFixture jgap;

    CrossoverAndMutationTest() throws InvalidConfigurationException {
        jgap = new JgapFixture(11, SIZE);
    }

    private List<IChromosome> children(OperatorSet set, int position, Population population)
            throws InvalidConfigurationException {
        EvolutionSettings settings = EvolutionSettings.of("thesis/creature-1", EncodingKind.DENSE, 2)
                .withSize(SIZE, 1).withOptimizer(OptimizerKind.JGAP, set, 0.05);
        GeneticOperator operator = Operators.alterers(settings, jgap.configuration, jgap.random).get(position);
        List<IChromosome> children = new ArrayList<>();
        operator.operate(population, children);
        return children;
    }

    @Test
    void crossoverMakesTwoChildrenOfEachOf35PercentPairs() throws InvalidConfigurationException {
        assertThat(children(OperatorSet.CORRECTED, 0, jgap.population(SIZE, GENES))).hasSize(2 * 52);
    }

    @Test
    void correctedCrossoverPairsNewbornsToo() throws InvalidConfigurationException {
        Population newborns = jgap.population(SIZE, GENES);
        for (IChromosome newborn : newborns.toChromosomes()) {
            newborn.resetAge();
        }

        assertThat(children(OperatorSet.CORRECTED, 0, newborns)).hasSize(2 * 52);
        assertThat(children(OperatorSet.STOCK, 0, newborns)).as("JGAP's own skips pairs of newborns").isEmpty();
    }

    /** All genes of a parent are equal here, so a child shows where it was cut. */
    @Test
    void crossoverSwapsAGeneAndAllAfterIt() throws InvalidConfigurationException {
        Set<Integer> cuts = new HashSet<>();
        for (int round = 0; round < 5; round++) {
            for (IChromosome child : children(OperatorSet.CORRECTED, 0, jgap.population(SIZE, GENES))) {
                List<Double> values = GeneticAlgorithm.genesOf(child);
                int changes = 0;
                for (int i = 1; i < GENES; i++) {
                    if (!values.get(i).equals(values.get(i - 1))) {
                        changes++;
                        cuts.add(i);
                    }
                }
                assertThat(changes).isLessThanOrEqualTo(1);
            }
        }
        assertThat(cuts).containsExactlyInAnyOrder(1, 2, 3, 4, 5, 6, 7, 8, 9);
    }

    @Test
    void mutationChangesFourPercentOfGenes() throws InvalidConfigurationException {
        int changed = 0;
        int rounds = 40;
        for (int round = 0; round < rounds; round++) {
            Population population = jgap.population(SIZE, GENES);
            Set<Double> present = new HashSet<>();
            for (IChromosome chromosome : population.toChromosomes()) {
                present.addAll(GeneticAlgorithm.genesOf(chromosome));
            }
            for (IChromosome child : children(OperatorSet.CORRECTED, 1, population)) {
                changed += (int) GeneticAlgorithm.genesOf(child).stream().filter(gene -> !present.contains(gene))
                        .count();
            }
        }

        double share = (double) changed / (rounds * SIZE * GENES);
        // Four standard errors of a share of 4 % of 60 000 genes.
        assertThat(share).isBetween(0.04 - 0.0032, 0.04 + 0.0032);
    }
}
