"""What the judge says: figures as they come, and at the end whether all were accepted."""


class Report:
    def __init__(self):
        self.failures = []
        self.checks = 0

    def say(self, text):
        print(text, flush=True)

    def fail(self, text):
        self.failures.append(text)
        self.say(f"  NOT ACCEPTED: {text}")

    def hold(self, what, seen, accepted, unit=""):
        """A figure and the largest that is accepted. NaN is not."""
        self.checks += 1
        words = f"{what} {seen:.4g}{unit}, accepted {accepted:.4g}{unit}"
        if seen <= accepted:
            self.say(f"  {words}")
        else:
            self.fail(words)

    def end(self):
        """Prints the verdict and returns the exit code."""
        if self.failures:
            self.say(f"\n./dev real FAILED: {len(self.failures)} of what was checked not accepted:")
            for text in self.failures:
                self.say(f"  {text}")
            return 1
        if not self.checks:
            self.say("\n./dev real FAILED: nothing was checked")
            return 1
        self.say(f"\n./dev real: all {self.checks} figures accepted")
        return 0
