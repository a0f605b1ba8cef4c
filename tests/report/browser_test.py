"""Opens the report in headless Chromium and uses it as a reader would.

    browser_test.py TEST_REPORT FOLDER      the program that writes the sample report, and where to put it and the screenshots
    browser_test.py --page INDEX_HTML FOLDER    the same questions asked of any report

Exit status 77 means skipped: no browser here.
"""
import base64
import os
import pathlib
import re
import subprocess
import sys
import time
import unittest

try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.chrome.options import Options
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.webdriver.support.ui import Select
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(77)

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--no-first-run", "--disable-quic", "--disable-dev-shm-usage",
         "--host-resolver-rules=MAP * ~NOTFOUND"]  # the page must ask nothing of a network
page = None
large_page = None
folder = None


def start(width=1280, height=900, dark=False, mouse=True):
    options = Options()
    for flag in FLAGS:
        options.add_argument(flag)
    if mouse:  # headless reports no pointer that hovers
        options.add_argument("--blink-settings=primaryHoverType=2,availableHoverTypes=2,primaryPointerType=4,availablePointerTypes=4")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
    if dark:
        driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    return driver


class Reader(unittest.TestCase):
    width, height, dark = 1280, 900, False

    @classmethod
    def setUpClass(cls):
        cls.driver = start(cls.width, cls.height, cls.dark)
        cls.driver.get(page.as_uri())
        cls.wait(lambda: cls.css("#rows tbody tr"))

    @classmethod
    def tearDownClass(cls):
        log = [entry for entry in cls.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]
        cls.driver.quit()
        if log:
            raise AssertionError("the console complains: " + "; ".join(entry["message"] for entry in log[:5]))

    @classmethod
    def css(cls, selector):
        return cls.driver.find_elements(By.CSS_SELECTOR, selector)

    @classmethod
    def one(cls, selector):
        return cls.driver.find_element(By.CSS_SELECTOR, selector)

    @classmethod
    def js(cls, script, *arguments):
        return cls.driver.execute_script(script, *arguments)

    @classmethod
    def wait(cls, condition, seconds=20):
        end = time.time() + seconds
        while time.time() < end:
            value = condition()
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError("waited in vain")

    def show(self, element_id):
        self.js("document.getElementById(arguments[0]).scrollIntoView({block: 'start', behavior: 'instant'})", element_id)
        time.sleep(0.2)

    def shot(self, name):
        self.driver.save_screenshot(str(folder / (name + ".png")))


class Wide(Reader):
    def column(self, key):
        index = self.js("return [...document.querySelectorAll('#rows th[data-key]')].findIndex(h => h.dataset.key === arguments[0])", key)
        texts = self.js("return [...document.querySelectorAll('#rows tbody tr')].map(r => r.cells[arguments[0]].textContent)", index)
        return texts

    def test_answer_and_pictures(self):
        self.assertRegex(self.one(".answer").text, r"\d")
        self.assertGreater(len(self.css("#sheet-grid img")), 3)
        self.js("document.querySelectorAll('img[loading=lazy]').forEach(i => i.loading = 'eager')")
        self.wait(lambda: self.js("return [...document.images].every(i => i.complete)"))
        broken = self.js("return [...document.images].filter(i => i.hasAttribute('src') && !i.naturalWidth).map(i => i.src)")
        self.assertEqual(broken, [])
        silent = self.js("return [...document.images].filter(i => i.hasAttribute('src') && !i.alt).length")
        self.assertEqual(silent, 0, "pictures without words")

    def test_modes_switch_pictures_and_legend(self):
        before = self.js("return [...document.querySelectorAll('#sheet-grid img')].map(i => i.src).join()")
        self.one("#sheet-mode input[value=wrong] + span").click()
        after = self.js("return [...document.querySelectorAll('#sheet-grid img')].map(i => i.src).join()")
        self.assertNotEqual(before, after)
        self.assertTrue(self.css("#sheet-legend .legend-bar"))
        # The legend stays in sight while the pictures scroll.
        self.js("document.querySelectorAll('.sheet tbody tr')[5].scrollIntoView({block: 'center', behavior: 'instant'})")
        box = self.one("#sheet-legend").rect
        scroll = self.js("return scrollY")
        self.assertTrue(0 <= box["y"] - scroll < self.height)
        self.shot("wrong")
        self.one("#sheet-mode input[value=picture] + span").click()

    def test_sorting(self):
        def numbers(key):
            return [float("inf") if text == "–" else float(text) for text in self.column(key)]
        for key in ("uv_error_texels.p99", "fetches.mean"):
            button = self.one(f"#rows th[data-key='{key}'] button")
            self.js("arguments[0].click()", button)
            ascending = numbers(key)
            self.assertEqual(ascending, sorted(ascending))
            self.js("arguments[0].click()", button)
            descending = [v for v in numbers(key) if v != float("inf")]
            self.assertEqual(descending, sorted(descending, reverse=True))
            self.assertEqual(self.one(f"#rows th[data-key='{key}']").get_attribute("aria-sort"), "descending")
        self.js("document.querySelector('#rows th[data-key=technique] button').click()")

    def test_filter(self):
        every = len(self.css("#rows tbody tr"))
        field = self.one("#filter")
        field.send_keys("mapping grazing")
        found = self.js("return [...document.querySelectorAll('#rows tbody tr')].map(r => r.textContent.toLowerCase())")
        self.assertTrue(0 < len(found) < every)
        self.assertTrue(all("mapping" in text and "grazing" in text for text in found))
        field.clear()
        field.send_keys("nothing is called so")
        self.assertEqual(len(self.css("#rows tbody tr")), 0)
        field.clear()
        field.send_keys(Keys.SPACE, Keys.BACKSPACE)
        self.assertEqual(len(self.css("#rows tbody tr")), every)

    def test_identical_pictures_have_the_best_psnr(self):
        for flip, psnr in zip(self.column("flip"), self.column("psnr_db")):
            if flip == "0":
                self.assertEqual(psnr, "∞")

    def test_best_is_marked_and_csv_is_copied(self):
        self.assertGreater(len(self.css("#rows td.best")), 0)
        self.js("document.getElementById('copy').click()")
        self.wait(lambda: self.one("#copy").get_attribute("data-csv"))
        self.assertGreater(int(self.one("#copy").get_attribute("data-csv")), 100)

    def test_divider_follows_and_is_dragged(self):
        self.show("compare")
        stage = self.one("#stage")
        split = lambda: int(self.one("#divider").get_attribute("aria-valuenow"))
        width = stage.rect["width"]
        move = lambda share: ActionChains(self.driver).move_to_element_with_offset(stage, int(width * (share - 0.5)), 20)
        if self.one("#follow").is_selected():
            self.js("document.getElementById('follow').click()")
        ActionChains(self.driver).move_to_element(self.one("#divider i")).click_and_hold().move_by_offset(int(width * 0.25), 0).release().perform()
        self.assertAlmostEqual(split(), 75, delta=2)
        move(0.4).perform()
        self.assertAlmostEqual(split(), 75, delta=2, msg="it must stay when it is not to follow")
        self.js("document.getElementById('follow').click()")
        move(0.3).perform()
        self.assertAlmostEqual(split(), 30, delta=2)
        clip = self.js("return getComputedStyle(document.querySelector('.pane.right')).clipPath")
        self.assertAlmostEqual(float(re.findall(r"([\d.]+)%", clip)[-1]), 30, delta=2)
        divider = self.one("#divider")
        divider.send_keys(Keys.ARROW_RIGHT)
        self.assertAlmostEqual(split(), 32, delta=2)
        self.shot("compare")

    def test_keys_change_technique_view_mode_and_zoom(self):
        stage = self.one("#stage")
        read = lambda: (self.one("#left").get_attribute("value"), self.one("#view").get_attribute("value"))
        technique, view = read()
        source = self.one("#left-image").get_attribute("src")
        stage.send_keys(Keys.ARROW_DOWN)
        self.assertNotEqual(read()[0], technique)
        self.assertNotEqual(self.one("#left-image").get_attribute("src"), source)
        stage.send_keys(Keys.ARROW_UP)
        self.assertEqual(read()[0], technique)
        stage.send_keys(Keys.ARROW_RIGHT)
        self.assertNotEqual(read()[1], view)
        stage.send_keys(Keys.ARROW_LEFT)
        stage.send_keys("2")
        self.assertTrue(self.one("#compare-mode input[value=wrong]").is_selected())
        stage.send_keys("1")
        stage.send_keys("+", "+")
        self.assertEqual(self.one("#zoom-level").text, "4.0×")
        transforms = self.js("return [...document.querySelectorAll('.pane img')].map(i => i.style.transform)")
        self.assertEqual(transforms[0], transforms[1], "zoom and pan must stay in step")
        stage.send_keys("0")
        self.assertEqual(self.one("#zoom-level").text, "1.0×")

    def test_zoomed_picture_is_dragged(self):
        self.show("compare")
        stage = self.one("#stage")
        stage.send_keys("+", "+")
        before = self.js("return document.getElementById('left-image').style.transform")
        ActionChains(self.driver).move_to_element_with_offset(stage, -200, 0).click_and_hold().move_by_offset(80, 40).release().perform()
        self.assertNotEqual(self.js("return document.getElementById('left-image').style.transform"), before)
        stage.send_keys("0")

    def test_inspector_reads_the_pixel(self):
        self.show("compare")
        stage = self.one("#stage")
        ActionChains(self.driver).move_to_element_with_offset(stage, 10, int(stage.rect["height"] * 0.1)).perform()
        text = self.wait(lambda: (lambda t: t if "Verdict" in t else "")(self.one("#inspector").text))
        for word in ("Pixel", "UV error", "Fetches", "Height", "Reference"):
            self.assertIn(word, text)
        rows = self.js("return [...document.querySelectorAll('#inspector tbody tr')].map(r => [...r.cells].map(c => c.textContent))")
        values = {row[0]: row[1:] for row in rows}
        self.assertRegex(values["Hit at"][-1], r"^-?\d+\.\d{4}, -?\d+\.\d{4}$")
        self.assertRegex(values["Height"][-1], r"^[01]\.\d{4}$")

    def test_plots(self):
        self.show("plots")
        for plot in ("#plot-fetches", "#plot-time"):
            self.assertGreater(len(self.css(plot + " .mark.default")), 3)
            self.assertEqual(len(self.css(plot + " .front")), 1)
            inside = self.js("""const s = document.querySelector(arguments[0] + ' svg').getBoundingClientRect();
                return [...document.querySelectorAll(arguments[0] + ' .mark')].every(m => { const b = m.getBoundingClientRect();
                    return b.left >= s.left - 9 && b.right <= s.right + 9 && b.top >= s.top - 9 && b.bottom <= s.bottom + 9; })""", plot)
            self.assertTrue(inside, "marks outside their plot")
        values = [option.get_attribute("value") for option in Select(self.one("#metric")).options]
        self.assertIn("flip", values)
        Select(self.one("#metric")).select_by_value("flip")
        self.assertIn("FLIP", self.one("#plot-time figcaption").text)
        Select(self.one("#metric")).select_by_value(values[0])
        mark = self.css("#plot-time .mark.default")[-1]
        ActionChains(self.driver).move_to_element(mark).perform()
        self.assertTrue(self.one("#tip").is_displayed())
        self.assertIn("Time", self.one("#tip").text)
        name = self.one("#tip strong").text
        self.shot("plots")
        ActionChains(self.driver).click(mark).perform()
        chosen = self.js("return document.getElementById('left').selectedOptions[0].textContent")
        self.assertEqual(chosen, name)
        self.wait(lambda: abs(self.js("return document.getElementById('compare').getBoundingClientRect().top")) < 200)

    def test_plot_by_keyboard(self):
        drawing = self.one("#plot-fetches svg")
        self.js("arguments[0].focus()", drawing)
        ActionChains(self.driver).send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT).perform()
        self.assertEqual(len(self.css("#plot-fetches .mark.chosen")), 1)
        self.assertTrue(self.one("#tip").is_displayed())
        ActionChains(self.driver).send_keys(Keys.ENTER).perform()
        self.wait(lambda: self.js("return document.activeElement.id") == "stage")

    def test_equal_terms(self):
        for table in ("#equal-error", "#equal-time"):
            self.assertGreater(len(self.css(table + " thead th")), 2)
            self.assertGreater(len(self.css(table + " td.best")), 0)

    def test_thumbnail_opens_large(self):
        cell = self.css("#sheet-grid .cell[data-technique]:not([data-technique=''])")[-1]
        technique = cell.get_attribute("data-technique")
        self.js("arguments[0].click()", cell)
        self.assertEqual(self.one("#left").get_attribute("value"), technique if technique else "")

    def test_material_switches_everything(self):
        select = Select(self.one("#material"))
        if len(select.options) < 2:
            self.skipTest("one material")
        select.select_by_index(1)
        name = select.options[1].text
        self.assertIn(name, self.one("#sheet-title").text)
        self.assertIn(name, self.one("#equal-scope").text)
        self.assertTrue(all(text == name for text in self.column("material")))
        select.select_by_index(0)

    def test_side_by_side(self):
        self.show("compare")
        self.js("document.getElementById('beside').click()")
        left, right = self.css(".pane")
        self.assertGreater(right.rect["x"], left.rect["x"] + left.rect["width"] - 2)
        self.shot("beside")
        self.js("document.getElementById('beside').click()")

    def test_every_technique_is_told_about(self):
        self.assertEqual(len(self.css("#about article")), self.js("return JSON.parse(document.getElementById('data').textContent).techniques.length"))
        self.assertGreater(len(self.css("#about cite")), 0)


class Narrow(Reader):
    width, height = 360, 740

    def test_no_sideways_scrolling(self):
        self.js("document.querySelectorAll('details').forEach(d => d.open = true)")
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), self.width)
        wide = self.js("""return [...document.querySelectorAll('main *')].filter(e => !e.closest('.scroll, #stage, svg, .legend') && e.getBoundingClientRect().right > innerWidth + 1)
            .map(e => e.tagName + '.' + e.className).slice(0, 5)""")
        self.assertEqual(wide, [])
        for part in ("answer", "sheet", "compare", "plots", "table"):
            self.show(part)
            self.shot("narrow_" + part)


class Dark(Reader):
    dark = True

    def test_ground_is_dark_and_text_reads(self):
        def luminance(colour):
            parts = [int(v) / 255 for v in re.findall(r"\d+", colour)[:3]]
            linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
            return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        ground = luminance(self.js("return getComputedStyle(document.body).backgroundColor"))
        self.assertLess(ground, 0.05)
        for selector in (".answer", ".note", "#about dd", "#about dt", "#rows td", "#rows td.best", ".mark"):
            ink = luminance(self.js("return getComputedStyle(document.querySelector(arguments[0])).color", selector))
            self.assertGreater((max(ink, ground) + 0.05) / (min(ink, ground) + 0.05), 4.5, selector)
        self.shot("dark")


class Light(Dark):
    dark = False

    def test_ground_is_dark_and_text_reads(self):
        self.assertIn("rgb(25", self.js("return getComputedStyle(document.body).backgroundColor"))

    def test_prints(self):
        pdf = self.driver.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})
        (folder / "report.pdf").write_bytes(base64.b64decode(pdf["data"]))
        self.assertGreater(len(pdf["data"]), 10000)


class Large(unittest.TestCase):
    """Thirty materials, three views, every technique: it must not get slow."""

    def test_opens_sorts_and_shows_all_rows_quickly(self):
        if large_page is None:
            self.skipTest("only with the sample report")
        driver = start()
        try:
            begin = time.time()
            driver.get(large_page.as_uri())
            opened = time.time() - begin
            spent = driver.execute_async_script("""
                const done = arguments[0];
                const times = [];
                const timed = (act) => { const start = performance.now(); act(); document.body.getBoundingClientRect(); times.push(performance.now() - start); };
                const all = document.getElementById('table-material');
                timed(() => { all.value = ''; all.dispatchEvent(new Event('change')); });
                timed(() => document.querySelector("#rows th[data-key='flip'] button").click());
                timed(() => { const m = document.getElementById('material'); m.value = '17'; m.dispatchEvent(new Event('change')); });
                requestAnimationFrame(() => done(times));""")
            print(f"large report: opened in {opened:.2f} s; all rows, sort, other material: " + ", ".join(f"{t:.0f} ms" for t in spent))
            driver.execute_script("const all = document.getElementById('table-material'); all.value = ''; all.dispatchEvent(new Event('change'))")
            shown, rows = re.match(r"(\d+) of (\d+)", driver.find_element(By.ID, "table-count").text).groups()
            self.assertEqual(shown, rows)
            rows = int(rows)
            self.assertGreater(rows, 1000)
            counts = []
            for _ in range(40):  # scrolled to its end, it has shown them all
                counts.append(driver.execute_script("const r = document.getElementById('rows'); r.scrollTop = r.scrollHeight; return r.querySelectorAll('tbody tr').length"))
                if counts[-1] == rows:
                    break
                time.sleep(0.1)
            self.assertLess(counts[0], 400)
            self.assertEqual(counts[-1], rows)
            # Generous: a shared machine of two cores; a tenth of this when it is idle.
            self.assertLess(opened, 15)
            self.assertLess(max(spent), 3000)
        finally:
            driver.quit()


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[-1]).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for program in ("/usr/bin/chromium", "/usr/bin/chromedriver"):
        if not os.path.exists(program):
            print(f"skipped: {program} is not installed (packages chromium, chromium-driver)")
            sys.exit(77)
    if sys.argv[1] == "--page":
        page = pathlib.Path(sys.argv[2]).resolve()
    else:
        environment = dict(os.environ, RELIEVO_SAMPLE_REPORT=str(folder / "sample_report"))
        subprocess.run([sys.argv[1], "--gtest_filter=Page.Writes*"], check=True, env=environment, stdout=subprocess.DEVNULL)
        page = folder / "sample_report" / "index.html"
        large_page = folder / "large_report" / "index.html"
    try:
        start().quit()
    except WebDriverException as error:
        print(f"skipped: Chromium does not start here: {error.msg}")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
